// One wedge of an open patch: its functions in space, and its matrix.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "benchmarks/elements/patch_nodes.h"
#include "benchmarks/elements/wedge.h"

namespace cleft::elements {

/// With its share of the skin, of the springs and of the load, by its place in the patch.
class Element {
 public:
  /// `corners`: places of the lower triangle, then of the upper one. `side` of the cut: -1 or 1.
  Element(const PatchNodes& nodes, std::array<Place, 6> corners, int side);

  const std::vector<int>& nodes() const { return numbers_; }
  const std::vector<Vec3>& points() const {
    return points_;
  }  ///< of the nodes that are no singular functions'

  Eigen::MatrixXd stiffness(const Parameters& parameters) const;
  /// Forces along v at the nodes, of the skin's tension that the cut releases (1 N/mm).
  Eigen::VectorXd released() const;

 private:
  struct Functions {
    Eigen::VectorXd value;
    Eigen::MatrixX3d slope;    ///< by u, v, w
    Eigen::Matrix3d jacobian;  ///< columns: by the reference coordinates
  };
  Functions functions(const WedgePoint& point) const;
  void add_singular(Functions& functions) const;
  bool is_on(const std::array<int, 2>& edge, int axis, int line) const;

  const PatchNodes& patch_;
  std::array<Place, 6> corners_;
  int side_;
  bool special_ = false;  ///< with singular functions, or moved middles of edges
  std::vector<int> numbers_;
  std::vector<Vec3> points_;
  std::vector<int> singular_;  ///< corners at a front
};

}  // namespace cleft::elements
