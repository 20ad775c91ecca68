#include "solver/iterative_solver.h"

#include <algorithm>

#include "base/error.h"
#include "solver/algebraic_solver.h"
#include "solver/grid_solver.h"

namespace cleft {

std::unique_ptr<FrameSolver> make_iterative_solver(const PatchMesh& mesh, const PatchSystem& system) {
  if (mesh.is_body()) return std::make_unique<AlgebraicSolver>(mesh, system);
  return std::make_unique<GridSolver>(mesh, system);
}

void refuse_contact(const std::vector<FrameSolver::Column>& columns) {
  if (std::any_of(columns.begin(), columns.end(), [](const auto& column) { return column.contact; }))
    throw SolveError(
        "cut.contact = true: contact is found with the factor, not by iterations; set it to false, use "
        "--method direct, or raise mesh.element_size or mesh.grading until the factor fits into memory");
}

double checked_norm(double norm) {
  if (!(norm < largest_norm))
    throw SolveError(
        "a load has values that are not numbers, or too large ones: see skin.prestress and the moduli");
  return norm;
}

double iterative_bytes_needed(const PatchMesh& mesh, const PatchSystem& system) {
  return mesh.is_body() ? AlgebraicSolver::bytes_needed(system) : GridSolver::bytes_needed(system);
}

}  // namespace cleft
