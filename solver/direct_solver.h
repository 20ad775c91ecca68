// All frames for about one factorisation of K: MUMPS, with the cut's unknowns as its Schur complement.
#pragma once

#include <Eigen/SparseCore>
#include <optional>

#include "solver/condensed_factor.h"
#include "solver/cut_nodes.h"
#include "solver/frame_solver.h"
#include "solver/opening.h"

namespace cleft {

class DirectSolver : public FrameSolver {
 public:
  /// Analyses only; factorize() must be called before the other functions.
  DirectSolver(const PatchMesh& mesh, const PatchSystem& system)
      : DirectSolver(mesh, system, system.lower_triangle()) {}
  /// Of another matrix of the system's unknowns, by its lower triangle.
  DirectSolver(const PatchMesh& mesh, const PatchSystem& system, PatchSystem::Entries entries);
  /// Takes another one with entries at the same places, which saves its analysis; factorize() comes next.
  void replace(PatchSystem::Entries entries);

  double bytes_needed() const;  ///< on this rank
  double operations() const { return factor_.operations(); }
  void factorize();
  /// Whether the matrix is positive definite among the displacements that the first `open` pairs of a release
  /// leave free, and touching pairs along their normals not.
  bool is_definite(const Release& release, int open, const std::vector<int>& touching) const;

  void set_release(const Release& release) override;
  void set_loads(Block loads, Together together = Together::all) override;
  Block solve(const std::vector<Column>& columns) override;
  Block solve_each(const Block& loads, const std::vector<Frame>& frames) override;

 private:
  /// Solves the columns in one block of MUMPS.
  Block solve_together(const std::vector<Column>& columns);

  /// T^T f in place, and the rows of the cut's nodes, in their order.
  Eigen::MatrixXd to_pulls(Block& loads) const;
  /// Displacements of the cut's nodes in place of jumps.
  void to_displacements(Block& solution) const;

  /// T^T K T, where the unknowns of right nodes are jumps. Keeps the entries between a jump and another
  /// unknown.
  PatchSystem::Entries stiffness_with_jumps(PatchSystem::Entries entries);

  const PatchSystem& system_;
  CutNodes cut_;
  std::vector<Vec3> normals_;                                  // by pair
  std::vector<int> jump_unknowns_;                             // those of the right nodes, by pair
  std::vector<Eigen::Triplet<double, int>> coupling_entries_;  // rank 0, until the factorisation
  CondensedFactor factor_;
  std::vector<int> neighbors_;            // unknowns that jumps act on
  Eigen::SparseMatrix<double> coupling_;  // between neighbors_ and jumps; rank 0, as all below
  std::optional<Opening> opening_;
  std::vector<Opening::Load> loads_;
  Together together_ = Together::all;
  Block interior_;  // K_ii^-1 f_i of every load; on all ranks
};

}  // namespace cleft
