// Frames by conjugate gradients, for patches whose factor does not fit into memory.
#pragma once

#include <memory>

#include "solver/frame_solver.h"

namespace cleft {

/// Of a patch, by the multigrid of its grid (solver/grid_solver.h); of a body, which has no grid, by an
/// algebraic one (solver/algebraic_solver.h).
std::unique_ptr<FrameSolver> make_iterative_solver(const PatchMesh& mesh, const PatchSystem& system);

/// What it needs on this rank.
double iterative_bytes_needed(const PatchMesh& mesh, const PatchSystem& system);

}  // namespace cleft
