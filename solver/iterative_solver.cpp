#include "solver/iterative_solver.h"

#include "solver/algebraic_solver.h"
#include "solver/grid_solver.h"

namespace cleft {

std::unique_ptr<FrameSolver> make_iterative_solver(const PatchMesh& mesh, const PatchSystem& system) {
  if (mesh.is_body()) return std::make_unique<AlgebraicSolver>(mesh, system);
  return std::make_unique<GridSolver>(mesh, system);
}

double iterative_bytes_needed(const PatchMesh& mesh, const PatchSystem& system) {
  return mesh.is_body() ? AlgebraicSolver::bytes_needed(system) : GridSolver::bytes_needed(system);
}

}  // namespace cleft
