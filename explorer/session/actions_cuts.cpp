// The mesh, the cuts in it and the tension of its skin: what they are, undone and redone.
#include "base/error.h"
#include "explorer/session/actions.h"
#include "explorer/wound/mesh_unit.h"

namespace cleft {

namespace {

void forget_cuts(SessionState& state) {
  state.cuts.clear(), state.undone.clear();
  state.tension.reset(), state.tensions.clear(), state.tensions_undone.clear();
  state.edits.clear(), state.edits_undone.clear();
  state.handled = -1;
}

/// Nothing that was undone can be made again after something new.
void forget_undone(SessionState& state) {
  state.undone.clear(), state.tensions_undone.clear(), state.edits_undone.clear();
}

/// The points of a cut, which is made anew, and those after it; at its end the picture stays at the end.
void put_cut(Session& session, std::size_t index, const CutState& cut) {
  const double t = session.state().time;
  const bool whole = t >= session.duration();
  session.edit().cuts[index] = cut;
  session.opened().drawn = {};
  set_time(session, whole ? session.duration() : t);  // makes the cuts, and throws where that is impossible
  follow_cuts(session);
  session.changes().cuts = true;
}

/// Likewise of a cut's points.
bool swap_edit(Session& session, std::vector<CutChange>& from, std::vector<CutChange>& to) {
  const SessionState& state = session.state();
  if (from.empty() || from.back().cuts != state.cuts.size() || from.back().tensions != state.tensions.size())
    return false;
  CutChange change = from.back();
  from.pop_back();
  const CutState cut = change.cut;
  change.cut = state.cuts[change.index];
  to.push_back(change);
  put_cut(session, change.index, cut);
  return true;
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
  opened.skin = nullptr;
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
  forget_undone(state);
  cuts_changed(session);
  if (first && !state.camera.pose) session.changes().camera = true;  // angles count from the first cut
}

void replace_last_cut(Session& session, const CutState& cut) {
  if (session.state().cuts.empty()) throw InputError("there is no cut yet (say: cut ...)");
  SessionState& state = session.edit();
  state.cuts.back() = cut;
  const std::size_t last = state.cuts.size() - 1;
  std::erase_if(state.edits, [last](const CutChange& edit) { return edit.index == last; });  // of another cut
  state.edits_undone.clear();
  cuts_changed(session);
}

void edit_cut(Session& session, std::size_t index, const CutEdit& edit) {
  const CutState before = session.state().cuts.at(index);
  const CutState after = edited(before, edit, session.skin());
  SessionState& state = session.edit();
  state.edits.push_back({state.cuts.size(), state.tensions.size(), index, before});
  forget_undone(state);
  put_cut(session, index, after);
}

void set_tension(Session& session, const std::optional<SkinTension>& tension) {
  if (tension) session.open_study();
  if (tension && !session.mesh()) throw InputError("there is no skin to pull (say: mesh FILE)");
  SessionState& state = session.edit();
  state.tensions.push_back({state.cuts.size(), state.tension});
  forget_undone(state);
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
  if (swap_edit(session, state.edits, state.edits_undone)) return;
  if (swap_tension(session, state.tensions, state.tensions_undone)) return;
  if (state.cuts.empty()) throw InputError("there is no cut and no tension to undo");
  state.undone.push_back(state.cuts.back());
  state.cuts.pop_back();
  if (state.handled >= static_cast<int>(state.cuts.size())) state.handled = -1;
  cuts_changed(session);
}

void redo_last(Session& session) {
  SessionState& state = session.edit();
  if (swap_edit(session, state.edits_undone, state.edits)) return;
  if (swap_tension(session, state.tensions_undone, state.tensions)) return;
  if (state.undone.empty()) throw InputError("there is no undone cut or tension to make again");
  state.cuts.push_back(state.undone.back());
  state.undone.pop_back();
  cuts_changed(session);
}

}  // namespace cleft
