// Frames by conjugate gradients, for patches whose factor does not fit into memory.
#pragma once

#include <memory>

#include "solver/frame_solver.h"

namespace cleft {

/// Conjugate gradients on the displacements that keep closed pairs together, preconditioned by smoothed
/// aggregation (Trilinos ML) with the six rigid-body modes. Copies that are tied take their mean: with that
/// projection P, P K P is solved with P M P, where M is a hierarchy for the patch as far open as the frame or
/// a few pairs further. A column starts from the one before of its load.
class IterativeSolver : public FrameSolver {
 public:
  IterativeSolver(const PatchMesh& mesh, const PatchSystem& system);
  ~IterativeSolver() override;

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
