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

/// The forces that a parameter adds to a patch that does not move, for each of its unit: those of the load,
/// and of the elements by differences of fourth order.
class ForcesOfParameter {
 public:
  ForcesOfParameter(const PatchSystem& system, const Parameters& parameters, const std::string& name)
      : load_(system.derivative(parameters, name)->load()) {
    for (const auto& [value, weight] : differences_by(parameters, name)) {
      Parameters moved = parameters;
      std::get<0>(find_parameter(name, "derivative").access)(moved) = value;
      patches_.push_back({std::make_unique<FinitePatch>(system, moved), weight});
      load_ -= weight * system.load(moved.skin);  // of which the patch has the prestress alone
    }
  }

  Block at(const Release& release, int open, const Block& displacement) const {
    Block sum = load_;
    for (const auto& [patch, weight] : patches_) {
      patch->set_open(release, open);
      sum += weight * patch->balance(displacement).left_over;
    }
    return sum;
  }

 private:
  Block load_;
  std::vector<std::pair<std::unique_ptr<FinitePatch>, double>> patches_;
};

}  // namespace

void solve_finite_series(SharedStiffness& shared, const Release& release, std::size_t number) {
  const PatchSystem& system = shared.system();
  const std::vector<std::string>& names = shared.job().options.sensitivities;
  CaseOutput output(shared, release, number, names);
  FinitePatch patch(system, output.parameters());
  const double largest_load = largest(system, system.load(output.parameters().skin));
  NewtonSolver newton(shared.mesh(), system, patch, release, *shared.chosen().solver, shared.residual(),
                      largest_load, output.parameters().cut.contact);
  std::vector<ForcesOfParameter> forces;
  forces.reserve(names.size());
  for (const std::string& name : names) forces.emplace_back(system, output.parameters(), name);
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
    if (names.empty()) continue;
    Block all(system.owned(), static_cast<Eigen::Index>(names.size()));
    for (std::size_t i = 0; i < names.size(); ++i)
      all.col(static_cast<Eigen::Index>(i)) = forces[i].at(release, release.released[frame], displacement);
    all = newton.responses(frame, displacement, all);
    for (std::size_t i = 0; i < names.size(); ++i)
      output.write_derivative(names[i], frame, all.col(static_cast<Eigen::Index>(i)));
    shared.phases().end("sensitivities");
  }
  output.finish();
  shared.phases().end("write");
}

}  // namespace cleft
