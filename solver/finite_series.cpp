#include "solver/finite_series.h"

#include <algorithm>
#include <iomanip>
#include <sstream>

#include "solver/newton.h"

namespace cleft {

namespace {

double largest(const PatchSystem& system, const Block& block) {
  double value = block.size() > 0 ? block.cwiseAbs().maxCoeff() : 0;
  MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_DOUBLE, MPI_MAX, system.communicator());
  return value;
}

/// A line for the log.
std::string text_of(const NewtonFrame& frame) {
  std::ostringstream text;
  text.precision(1);
  text << std::scientific << "frame " << frame.frame << ": residual";
  for (const NewtonStep& step : frame.steps) {
    text << ' ' << step.residual << " (" << step.iterations;
    if (step.length < 1)
      text << ", step " << std::fixed << std::setprecision(2) << step.length << std::scientific
           << std::setprecision(1);
    text << (step.indefinite ? ", indefinite)" : ")");
  }
  text << ' ' << frame.residual;
  if (frame.load_steps > 1) text << ", in " << frame.load_steps << " parts of the load";
  return text.str();
}

}  // namespace

void solve_finite_series(SharedStiffness& shared, const Release& release, std::size_t number) {
  const PatchSystem& system = shared.system();
  CaseOutput output(shared, release, number, {});
  FinitePatch patch(system, output.parameters());
  const double largest_load = largest(system, system.load(output.parameters().skin));
  NewtonSolver newton(shared.mesh(), system, patch, release, *shared.chosen().solver, shared.residual(),
                      largest_load);
  Block displacement = Block::Zero(system.owned(), 1);
  const int frames = static_cast<int>(release.released.size());
  for (int frame = 0; frame < frames; ++frame) {
    shared.job().progress("frame " + std::to_string(frame) + " of " + std::to_string(frames));
    const NewtonFrame solved = newton.solve(frame, displacement);
    if (shared.job().options.log) shared.job().options.log(text_of(solved));
    output.report().newton.push_back(solved);
    output.add_figures(shared.residual().figures(release, {{0, release.released[frame], false, 0}},
                                                 displacement, newton.left_over(), largest_load));
    shared.phases().end("frames");
    if (!output.continues()) return;
    output.write_frames(frame, displacement);
    shared.phases().end("write");
  }
  output.finish();
  shared.phases().end("write");
}

}  // namespace cleft
