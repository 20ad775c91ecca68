// Frames by conjugate gradients with the multigrid of the patch's grid.
#pragma once

#include <memory>

#include "solver/frame_solver.h"

namespace cleft {

/// Conjugate gradients on the displacements that keep closed pairs together: P K P, where the projection P
/// replaces tied copies by their mean. One hierarchy (solver/multigrid) serves all frames, and eight of them
/// are solved at a time: K and the levels are read once for all eight. The columns of a load start from its
/// last one before these.
class GridSolver : public FrameSolver {
 public:
  /// Of a mesh with a grid.
  GridSolver(const PatchMesh& mesh, const PatchSystem& system);
  ~GridSolver() override;

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
