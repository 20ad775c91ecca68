// Frames by conjugate gradients, where a factor does not fit into memory or takes longer.
#pragma once

#include <memory>

#include "solver/frame_solver.h"

namespace cleft {

/// Of a patch, by the multigrid of its grid (solver/grid_solver.h); of a body, which has no grid, by an
/// algebraic one (solver/algebraic_solver.h).
std::unique_ptr<FrameSolver> make_iterative_solver(const PatchMesh& mesh, const PatchSystem& system);

/// Contact is found with the factor: throws SolveError where a column asks for it.
void refuse_contact(const std::vector<FrameSolver::Column>& columns);

/// Squares of loads beyond this, or of those below its inverse, leave the range of numbers.
inline constexpr double largest_norm = 1e150;
/// A load's norm; throws SolveError if the load has values that are not numbers, or too large ones.
double checked_norm(double norm);

/// What it needs on this rank.
double iterative_bytes_needed(const PatchMesh& mesh, const PatchSystem& system);

}  // namespace cleft
