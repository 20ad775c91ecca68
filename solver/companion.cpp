#include "solver/companion.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "params/consistency.h"
#include "solver/frame_figures.h"
#include "solver/frame_solver.h"

namespace cleft {

namespace {

constexpr double least_grading = 1.3;  // of the wider patch, so that it does not cost more than the case

}  // namespace

double gape_of(const Parameters& parameters, MPI_Comm communicator) {
  check_consistency(parameters, "companion");
  const PatchMesh mesh = make_patch_mesh(parameters);
  const PatchSystem system(mesh, parameters, communicator);
  const Release release = make_release(mesh, parameters);
  const ChosenSolver chosen = make_frame_solver(mesh, system, Method::automatic, [](const std::string&) {});
  const Block load = system.load(parameters.skin);
  const std::vector<FrameSolver::Column> columns = {
      {0, release.released.back(), parameters.cut.contact, 1e-6}};
  chosen.solver->set_release(release);
  chosen.solver->set_loads(load);
  const Block found = chosen.solver->solve(columns);
  const FrameResidual residual(mesh, system);
  return residual.figures(release, columns, found, residual.left_over(load, found), 1).front().gape;
}

std::optional<ExpectedError> expected_error(const Parameters& parameters, double gape,
                                            MPI_Comm communicator) {
  if (!(gape > 0)) return {};
  Parameters coarse = parameters;
  coarse.mesh.element_size *= 2;
  Parameters wide = coarse;
  wide.patch.length *= 2, wide.patch.width *= 2;
  wide.mesh.grading = std::max(least_grading, wide.mesh.grading);
  try {
    const double coarser = gape_of(coarse, communicator), wider = gape_of(wide, communicator);
    return ExpectedError{std::abs(coarser - gape) / gape, std::abs(wider - coarser) / gape};
  } catch (const InputError&) {
  } catch (const SolveError&) {
  }
  return {};
}

}  // namespace cleft
