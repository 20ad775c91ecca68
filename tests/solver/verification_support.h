// What the verification tests share: boxes without a cut, and a solve apart from those of the solver.
#pragma once

#include <Eigen/SparseCore>
#include <string>
#include <vector>

#include "solver/patch_mesh.h"
#include "solver/patch_system.h"

namespace cleft {

inline constexpr double none = 1e-14;  ///< moduli must be positive: this one vanishes against all others

/// `count` equal elements between two places.
std::vector<double> even_lines(double from, double to, int count);

/// A box of wedges without a cut, its squares halved as the solver halves them for a formulation. Lines
/// increase; w ends at the skin.
PatchMesh box_mesh(TissueFormulation formulation, const std::vector<double>& u, const std::vector<double>& v,
                   const std::vector<double>& w);

/// One layer of wedges under the skin of a mesh, its open cut going through; the skin's nodes keep their
/// order, and those below are `count` further, where `count` is half of them.
PatchMesh sheet_of(const PatchMesh& mesh, double height);

/// Moves the nodes inside the box by up to a part of the given edge along each axis; the nodes of a pair move
/// together.
void jitter(PatchMesh& mesh, double part, double edge);

/// Nodes on the surface of the box that bounds the points (those of a cut inside the skin included).
std::vector<bool> on_surface(const PatchMesh& mesh);

/// Force on every node of unit traction on triangles: a third of each one's area per corner.
Eigen::VectorXd areas_of_nodes(const PatchMesh& mesh, const std::vector<std::array<int, 3>>& triangles);

/// Conditions on unknowns: to have a value, or to be equal to others.
class Conditions {
 public:
  explicit Conditions(const PatchSystem& system);

  void fix(int node, int axis, double value = 0);
  void tie(int node, int other, int axis);
  void tie(int node, int axis, int other, int other_axis);

  /// K u = f where no condition says otherwise, by Eigen's sparse Cholesky factors. K is linear in its
  /// moduli; those that are `none` leave errors of their ratio to the others.
  Eigen::VectorXd solve(const Eigen::VectorXd& load) const;

 private:
  int group(int unknown) const;

  const PatchSystem& system_;
  mutable std::vector<int> parent_;  // of each unknown, up to the one that stands for its group
  std::vector<bool> fixed_;
  Eigen::VectorXd value_;
};

}  // namespace cleft
