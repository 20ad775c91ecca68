// Frames by conjugate gradients, for bodies, which have no grid.
#pragma once

#include <memory>

#include "solver/frame_solver.h"

namespace cleft {

/// Conjugate gradients on the displacements that keep closed pairs together, preconditioned by smoothed
/// aggregation (Trilinos ML) with the six rigid-body modes. The projection P replaces tied copies by their
/// mean; P K P is solved with the preconditioner P M P, where M is a multigrid hierarchy for the body as far
/// open as the frame or a few pairs further. A column starts from the previous one of its load.
class AlgebraicSolver : public FrameSolver {
 public:
  AlgebraicSolver(const PatchMesh& mesh, const PatchSystem& system);
  ~AlgebraicSolver() override;

  static double bytes_needed(const PatchSystem& system);  ///< on this rank

  void set_release(const Release& release) override;
  void set_loads(Block loads, Together together = Together::all) override;
  Block solve(const std::vector<Column>& columns) override;
  std::vector<int> iterations() const override;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace cleft
