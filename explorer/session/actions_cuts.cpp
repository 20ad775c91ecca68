// The mesh, the cuts in it and the tension of its skin: what they are, undone and redone.
#include "base/error.h"
#include "explorer/session/actions.h"
#include "explorer/wound/mesh_unit.h"

namespace cleft {

namespace {

void forget_cuts(SessionState& state) {
  state.cuts.clear(), state.undone.clear();
  state.tension.reset(), state.tensions.clear(), state.tensions_undone.clear();
}

void cuts_changed(Session& session) {
  session.opened().drawn = {};
  session.edit().time = session.duration();  // makes the cuts, and throws where they cannot be made
  follow_cuts(session);
  session.changes().cuts = session.changes().time = true;
}

void tension_changed(Session& session) {
  follow_parameters(session);
  session.opened().drawn.scenes.clear();
  set_time(session, session.state().time);  // makes the scenes, and throws where they cannot be made
  session.changes().cuts = true;
}

/// The last change, taken from one list and put on the other, if it was made at the present number of cuts.
bool swap_tension(Session& session, std::vector<TensionChange>& from, std::vector<TensionChange>& to) {
  SessionState& state = session.edit();
  if (from.empty() || from.back().cuts != state.cuts.size()) return false;
  to.push_back({from.back().cuts, state.tension});
  state.tension = from.back().tension;
  from.pop_back();
  tension_changed(session);
  return true;
}

}  // namespace

void read_surfaces(const Session& session, Opened& opened) {
  const SessionState& state = opened.state;
  const auto in_mm = [&](const std::string& file) {
    SurfaceMesh mesh = session.services().read_mesh(file);
    for (Vec3& x : mesh.points) x *= state.scale;
    return mesh;
  };
  opened.mesh = state.mesh.empty() ? nullptr : std::make_shared<const SurfaceMesh>(in_mm(state.mesh));
  opened.bone = state.bone.empty() ? nullptr : std::make_shared<const SurfaceIndex>(in_mm(state.bone));
}

void load_mesh(Session& session, const std::string& file, double scale) {
  SessionState& state = session.edit();
  state.mesh = absolute_path(file);
  state.scale = scale;
  forget_cuts(state);
  state.clip.reset();
  state.bone.clear();
  read_surfaces(session, session.opened());
  state.coloring = session.mesh()->colors.empty() ? Coloring::tissue : Coloring::own;
  state.zoom.reset(), state.figure.clear(), state.ruler.clear();
  state.camera = {};
  if (!session.mesh()->note.empty()) session.answer(file + ": " + session.mesh()->note);
  if (const std::string doubt =
          doubt_of_size(extent_of(*session.mesh()) / scale, scale, session.cut_length_of_fields());
      !doubt.empty())
    session.answer("warning: " + doubt + " (command unit)");
  cuts_changed(session);
  session.changes().all();
}

void show_patch(Session& session) {
  session.open_study();
  SessionState& state = session.edit();
  state.mesh.clear(), state.bone.clear(), state.ruler.clear();
  forget_cuts(state);
  state.clip.reset();
  read_surfaces(session, session.opened());
  follow_parameters(session);  // no tension keeps it from what lies between cases
  state.coloring = Coloring::displacement;
  state.figure.clear();
  state.camera = {};
  cuts_changed(session);
  session.changes().all();
}

void add_cut(Session& session, const CutState& cut) {
  if (!session.mesh()) throw InputError("there is no mesh to cut (say: mesh FILE)");
  SessionState& state = session.edit();
  const bool first = state.cuts.empty();
  state.cuts.push_back(cut);
  state.undone.clear(), state.tensions_undone.clear();
  cuts_changed(session);
  if (first && !state.camera.pose) session.changes().camera = true;  // angles count from the first cut
}

void replace_last_cut(Session& session, const CutState& cut) {
  if (session.state().cuts.empty()) throw InputError("there is no cut yet (say: cut ...)");
  session.edit().cuts.back() = cut;
  cuts_changed(session);
}

void set_tension(Session& session, const std::optional<SkinTension>& tension) {
  if (tension) session.open_study();
  if (tension && !session.mesh()) throw InputError("there is no skin to pull (say: mesh FILE)");
  SessionState& state = session.edit();
  state.tensions.push_back({state.cuts.size(), state.tension});
  state.undone.clear(), state.tensions_undone.clear();
  state.tension = tension;
  tension_changed(session);
}

void put_bone(Session& session, const std::string& file) {
  if (!session.mesh()) throw InputError("there is no mesh that the bone is below (say: mesh FILE)");
  session.edit().bone = file.empty() ? "" : absolute_path(file);
  read_surfaces(session, session.opened());
  cuts_changed(session);
}

void undo_last(Session& session) {
  SessionState& state = session.edit();
  if (swap_tension(session, state.tensions, state.tensions_undone)) return;
  if (state.cuts.empty()) throw InputError("there is no cut and no tension to undo");
  state.undone.push_back(state.cuts.back());
  state.cuts.pop_back();
  cuts_changed(session);
}

void redo_last(Session& session) {
  SessionState& state = session.edit();
  if (swap_tension(session, state.tensions_undone, state.tensions)) return;
  if (state.undone.empty()) throw InputError("there is no undone cut or tension to make again");
  state.cuts.push_back(state.undone.back());
  state.undone.pop_back();
  cuts_changed(session);
}

}  // namespace cleft
