#include "explorer/commands/cut_simulated.h"

#include <algorithm>
#include <functional>

#include "base/error.h"
#include "base/text.h"
#include "explorer/body/body_warnings.h"
#include "explorer/body/simulate.h"
#include "explorer/body/simulated_wounds.h"
#include "explorer/commands/cut_figures.h"
#include "explorer/wound/path_file.h"
#include "params/parameters/table.h"
#include "params/run/signal_handler.h"

namespace cleft {

namespace {

bool is_of_body(const std::string& name) {
  for (const char* start : {"skin.", "tissue.", "foundation."})
    if (name.starts_with(start)) return !name.starts_with("skin.curvature");
  return name == "model";
}

/// In what the field's body is another one: "NAME = VALUE (simulated: VALUE), ..."; empty if in nothing.
std::string differences(const CutFields& fields, const Parameters& simulated) {
  std::string text;
  for (const Parameter& row : parameter_table()) {
    const auto own = fields.shape().parameters.find(row.name);
    if (!own || !is_of_body(row.name) || (fields.turning() && row.name.starts_with("skin.prestress_")))
      continue;
    if (const Value there = get_parameter(simulated, row); there != *own)
      text += (text.empty() ? "" : ", ") + row.name + " = " + to_text(*own) +
              " (simulated: " + to_text(there) + ")";
  }
  return text;
}

}  // namespace

BodyRequest body_to_simulate(const BodyOptions& options, const std::optional<SkinTension>& tension,
                             const std::optional<CutFields>& fields, double scale) {
  RecordedParameters of_field;
  if (fields) of_field = fields->shape().parameters;
  if (fields && fields->turning()) {
    const Prestress usual = Parameters{}.skin.prestress;
    of_field.set("skin.prestress_u", usual.uu), of_field.set("skin.prestress_v", usual.vv);
    of_field.set("skin.prestress_uv", usual.uv);
  }
  BodyRequest request = options.request(scale, of_field);
  if (!tension) return request;
  for (const char* name : {"--direction", "--direction-lines"})
    if (options.given(name))
      throw InputError(std::string(name) + ": is of the same tension as --prestress; give one of them");
  for (const std::string& assignment : options.assignments)
    if (assignment.starts_with("skin.prestress_"))
      throw InputError("--set " + assignment + ": is of the same tension as --prestress; give one of them");
  request.parameters.skin.prestress = {tension->larger, tension->smaller, 0};
  request.tension = lines_of(*tension);
  return request;
}

CutFields in_tension_of(const BodyRequest& request, const CutFields& fields,
                        const std::vector<std::string>& paths, const MeshCuts& cuts) {
  for (std::size_t k = 0; k < paths.size(); ++k)
    if (read_prestress(paths[k], cuts.cuts()[k]->path(), cuts.scale()))
      throw FileError(
          paths[k],
          "has prestresses along the path, and a simulation takes one tension: give --tension and "
          "--prestress in place of its columns skin.prestress_u, _v and _uv");
  const Prestress& stress = request.parameters.skin.prestress;
  if (fields.turning() && stress.uv != 0)
    throw InputError("skin.prestress_uv = " + shortest(stress.uv) +
                     ": not with --field and --simulate; give the principal tensions with --tension and "
                     "--prestress");
  SkinTension tension = default_tension(cuts.cuts().front()->path(), false);
  if (!request.tension.empty()) {
    tension.direction = request.tension.front().direction;
    if (request.tension.size() > 1)
      tension.lines = std::make_shared<const std::vector<TensionLine>>(request.tension);
  }
  tension.larger = stress.uu, tension.smaller = stress.vv;
  return fields.in_tension(tension);
}

Json move_as_simulated(BodyRequest request, const MeshCuts& cuts, const std::optional<CutFields>& fields,
                       std::vector<Vec3>& positions) {
  const double scale = cuts.scale();
  request.skin = scaled(cuts.uncut(), scale);
  for (const Incision* one : cuts.cuts()) request.paths.push_back(one->path().scaled(scale));
  Progress progress("simulating");
  static StopCount stop = 0;
  const BodySimulation simulation = [&] {
    const SignalHandler handler({SIGINT, SIGTERM}, [](int) { stop = stop + 1; });
    return simulate(request, std::ref(progress), &stop);
  }();
  const SimulatedWounds wounds(cuts.cuts(), scale, simulation.body, *simulation.series);
  std::vector<Vec3> simulated(positions.size());
  wounds.positions(cuts.progress(), simulated);
  const CutMesh& mesh = cuts.cuts().front()->mesh();
  const std::vector<int> turned = turned_triangles(mesh, simulated);
  Json told = figures_of(simulation.report);
  told["warnings"] = simulation.warnings;
  told["gape_mm"] = wounds.gape(cuts.progress());
  told["seconds"] = simulation.seconds;
  told["moved_vertices"] = wounds.active();
  double most = 0;
  for (const Guard::Change& change : wounds.guard().changes()) most = std::max(most, change.by * scale);
  told["guarded_vertices"] = wounds.guard().changes().size();
  told["guarded_mm"] = most;
  told["unsound_triangles"] = turned.size();
  for (const std::string& warning :
       {warning_of_guard(mesh, wounds.guard(), wounds.gape(cuts.progress()), scale),
        warning_of_turned(mesh, turned, scale)})
    if (!warning.empty()) told["warnings"].push_back(warning);
  if (fields) {
    told["replay"] = figures_of(wounds.off(cuts.cuts(), positions, cuts.progress()), scale);
    if (const std::string other = differences(*fields, request.parameters); !other.empty())
      told["warnings"].push_back("the field of the replay is of another body than is simulated: " + other);
  }
  print_warnings(told["warnings"], "cleft cut");
  positions = std::move(simulated);
  return told;
}

}  // namespace cleft
