// The cuts in the mesh, simulated as they are.
#include <cmath>

#include "base/error.h"
#include "base/text.h"
#include "explorer/body/body_warnings.h"
#include "explorer/scene/mesh_scene.h"
#include "explorer/session/actions.h"
#include "params/parameters/table.h"

namespace cleft {

namespace {

/// Those of the shown case; of a family, whose cases are of any shape and tension, those of the one in the
/// middle, in the tension in which the family opens cuts.
Parameters parameters_of_shown(Session& session) {
  Parameters parameters;
  if (const auto field = session.field()) parameters = parameters_of_body(field->parameters);
  if (const auto family = session.opened().cases ? session.opened().cases->family() : nullptr) {
    parameters = parameters_of_body(family->shape().parameters);
    parameters.skin.prestress = Parameters{}.skin.prestress;
  }
  if (const auto& tension = session.state().tension)
    parameters.skin.prestress = {tension->larger, tension->smaller, 0};
  return parameters;
}

BodyRequest request_of(Session& session) {
  BodyRequest request;
  request.skin = *session.mesh();
  request.paths = session.cut_paths();
  request.parameters = parameters_of_shown(session);
  if (const auto& tension = session.state().tension) request.tension = lines_of(*tension);
  request.bone = session.opened().bone;
  return request;
}

/// All that a simulation depends on.
std::string key_of(const BodyRequest& request, const std::string& mesh) {
  std::string key = mesh;
  for (const Parameter& row : parameter_table()) key += ";" + to_text(get_parameter(request.parameters, row));
  const auto add = [&](const Vec3& x) {
    key += ";" + shortest(x.x) + "," + shortest(x.y) + "," + shortest(x.z);
  };
  for (const auto& [place, direction] : request.tension) add(place), add(direction);
  for (const ScalpelPath& path : request.paths) {
    constexpr int places = 200;
    for (int i = 0; i <= places; ++i) {
      const double s = path.length() * i / places;
      const PathFrame at = path.at(s);
      add(at.position), add(at.outward);
      key += "," + shortest(path.depth(s));
    }
  }
  return key;
}

std::string percent(double part) { return shortest(std::round(1000 * part) / 10) + " %"; }

}  // namespace

void simulate_cuts(Session& session, bool on) {
  if (on && !session.mesh()) throw InputError("there is no mesh with cuts to simulate (say: mesh FILE)");
  session.edit().simulate = on;
  if (!on && session.state().coloring == Coloring::error) color_by(session, Coloring::displacement);
  follow_cuts(session);
  set_time(session, session.state().time);
  session.changes().cuts = session.changes().shown = true;
}

void follow_cuts(Session& session) {
  Simulated& simulated = session.opened().simulated;
  const bool asked = session.state().simulate && session.mesh() && !session.state().cuts.empty();
  if (!asked) {
    if (!simulated.of.empty()) session.opened().drawn.scenes.clear();
    simulated = {};
    return;
  }
  BodyRequest request = request_of(session);
  const std::string key = key_of(request, session.state().mesh + ";" + session.state().bone);
  if (key == simulated.of) return;
  simulated = {key, std::make_shared<BodyRun>(std::move(request)), nullptr, nullptr,
               "simulating; this is the replay"};
  session.opened().drawn.scenes.erase(session.state().shown);
  if (session.prepares_beside()) return;
  simulated.run->wait([&] { session.progress("simulating the cuts: " + simulated.run->step(), 0.5); });
  finish_simulation(session);
}

void finish_simulation(Session& session) {
  Simulated& simulated = session.opened().simulated;
  if (!simulated.run) return;
  const std::shared_ptr<BodyRun> run = std::move(simulated.run);
  simulated.run = nullptr;
  session.changes().cuts = session.changes().shown = true;
  try {
    const BodySimulation& result = run->result();
    const std::shared_ptr<const CutSurface> cut = session.shown_cut_surface();
    std::vector<const Incision*> cuts;
    for (const auto& one : cut->cuts()) cuts.push_back(one.get());
    simulated.wounds = std::make_shared<const SimulatedWounds>(cuts, 1, result.body, *result.series);
    simulated.ended = run;
    session.opened().drawn.scenes.erase(session.state().shown);
    simulated.note = "simulated, " + std::to_string(result.report.nodes) + " nodes";
    std::vector<Vec3> moved(cuts.front()->mesh().vertices().size());
    simulated.wounds->positions(simulated.wounds->duration(), moved);
    const CutMesh& mesh = cuts.front()->mesh();
    std::vector<std::string> warnings = result.warnings;
    warnings.push_back(warning_of_guard(mesh, simulated.wounds->guard(),
                                        simulated.wounds->gape(simulated.wounds->duration()), 1));
    warnings.push_back(warning_of_turned(mesh, turned_triangles(mesh, moved), 1));
    for (const std::string& warning : warnings)
      if (!warning.empty()) session.answer("the simulation: " + warning);
    if (const auto scene = std::dynamic_pointer_cast<const MeshScene>(session.scene()))
      if (const auto off = scene->replay_off())
        simulated.note += "; the opening of the replay was off by " + percent(off->relative_opening());
  } catch (const std::runtime_error& e) {  // of input, too: the replay remains
    simulated.wounds = nullptr, simulated.ended = nullptr;
    simulated.note = std::string("not simulated: ") + e.what();
    session.answer(simulated.note);
  }
}

}  // namespace cleft
