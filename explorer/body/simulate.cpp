#include "explorer/body/simulate.h"

#include <algorithm>
#include <stdexcept>

#include "base/error.h"
#include "base/message.h"
#include "base/output_file.h"
#include "base/scratch_folder.h"
#include "base/stopwatch.h"
#include "base/text.h"
#include "explorer/body/body_warnings.h"
#include "params/parameters/lip_formulation.h"
#include "params/parameters/table.h"
#include "params/study.h"
#include "solver/body/skin_turn.h"

namespace cleft {

namespace {

constexpr std::size_t most_frames = 64;  // between which positions are linear

/// What the solver said last, without its name and those of temporary files.
std::string last_message(const std::string& log, const std::string& case_file) {
  std::string text = read_text_file(log);
  for (auto at = text.find(case_file); at != std::string::npos; at = text.find(case_file))
    text.erase(at, case_file.size());
  return last_error(std::move(text), "it said nothing");
}

void end_if_stopped(const StopCount* stop) {
  if (stop && *stop > 0) throw std::runtime_error("the simulation was stopped");
}

/// Of the body in the folder. Returns the displacements of the last frame.
std::vector<Vec3> solve(BodySimulation& result, const Parameters& parameters, const ScratchFolder& folder,
                        const StopCount* stop) {
  Case one;
  one.parameters = parameters;
  write_text_file(folder / "case.toml", case_file_text(one));
  result.series = nullptr;
  const ProcessResult ended =
      run_process({command_path("solve"), folder / "case.toml", "--mesh", folder / "body.h5", "--out",
                   folder / "case.h5", "--no-estimate", "--json"},
                  folder / "solve.log", {}, stop, folder / "solve.json");
  if (!ended.success()) {
    end_if_stopped(stop);
    const std::string what =
        "the body could not be solved: " + last_message(folder / "solve.log", folder / "case.toml: ");
    if (ended.exit_code == 2) throw InputError(what);
    throw std::runtime_error(what);
  }
  result.series = std::make_unique<SnapshotReader>(folder / "case.h5");
  return result.series->displacement(result.series->snapshot().frames() - 1);
}

}  // namespace

Parameters parameters_of_body(const RecordedParameters& of_case) {
  const Parameters defaults;
  Parameters parameters;
  for (const Parameter& row : parameter_table())
    if (const auto value = of_case.find(row.name)) put_parameter(parameters, row, *value);
  parameters.cut.radius = 0, parameters.cut.tilt = 0, parameters.cut.count = 1, parameters.cut.branch = 0;
  parameters.skin.edges = SkinEdges::held;
  parameters.mesh.front = defaults.mesh.front, parameters.mesh.elements = defaults.mesh.elements;
  return parameters;
}

void thin_frames(Body& body, std::size_t most) {
  const std::size_t frames = body.times.size();
  if (frames <= most) return;
  const double step = body.times.back() / static_cast<double>(most - 1);
  std::size_t kept = 1;
  for (std::size_t i = 1; i < frames; ++i) {
    const bool ends_a_cut = i + 1 == frames || body.position[i + 1] < body.position[i];
    if (!ends_a_cut && body.times[i] < body.times[kept - 1] + step) continue;
    body.times[kept] = body.times[i], body.position[kept] = body.position[i];
    body.released[kept] = body.released[i];
    ++kept;
  }
  body.times.resize(kept), body.position.resize(kept), body.released.resize(kept);
  body.hash = hash_of(body);
}

BodySimulation simulate(BodyRequest request, const std::function<void(const std::string&)>& progress,
                        const StopCount* stop) {
  const auto tell = [&](const std::string& step) {
    if (progress) progress(step);
  };
  const Stopwatch watch;
  const ScratchFolder folder("simulate");
  BodySimulation result;
  tell("meshing the body");
  if (!request.own_formulation) settle_formulation(request.parameters, tilt_of(request));
  result.body = make_body(request, &result.report);
  thin_frames(result.body, most_frames);
  result.report.frames = static_cast<int>(result.body.times.size());
  result.warnings = warnings_of(result.report);
  end_if_stopped(stop);
  write_body(folder / "body.h5", result.body);
  Parameters parameters = request.parameters;
  parameters.cut.contact = true;  // of cuts that meet lips would pass through each other
  const std::string solving = "solving " + std::to_string(result.report.nodes) + " nodes";
  tell(solving);
  std::vector<Vec3> open = solve(result, parameters, folder, stop);
  if (const Turn most = most_turned_skin(result.body, open);
      most.angle > much_turn && lacks_stiffness_of_tension(parameters)) {
    parameters.skin.turning_stiffness = turning_share(most.angle);
    tell(solving + " again");
    open = solve(result, parameters, folder, stop);
    result.warnings.push_back(warning_of_turn(most, parameters.skin.turning_stiffness));
  }
  for (const BodyPair& pair : result.body.pairs)
    result.gape = std::max(result.gape, dot(pair.normal, open[pair.right] - open[pair.left]));
  result.seconds = watch.seconds();
  return result;
}

}  // namespace cleft
