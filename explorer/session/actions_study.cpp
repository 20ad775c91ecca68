// Opening and closing studies, saved sessions, and time.
#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/error.h"
#include "explorer/session/actions.h"

namespace cleft {

namespace {

/// What stays of a state when another study is opened: the mesh with its cuts, the view, playing's settings.
SessionState state_at_first_case(SessionState state, const std::string& path, const KnownCases& cases) {
  state.study = absolute_path(path);
  state.shown = 0;
  state.parameters = cases.varying_parameters(0);
  state.compared.clear();
  state.brushes.clear();
  state.where.clear();
  state.filtered = false;
  state.sorted_by.clear(), state.descending = false, state.selected.clear();
  state.analyzed.clear();
  state.reference = -1;
  state.probe.reset(), state.zoom.reset(), state.figure.clear();
  if (state.mesh.empty()) state.ruler.clear();
  if (needs_reference(state.coloring) || state.coloring == Coloring::error)
    state.coloring = Coloring::displacement;
  state.clip.reset();
  state.playing = false;
  return state;
}

void check_case(int i, int cases, const char* what) {
  if (i < 0 || i >= cases)
    throw InputError(std::string(what) + " " + std::to_string(i + 1) + ": there are the cases 1 to " +
                     std::to_string(cases));
}

void check_cases(const SessionState& state, int cases) {
  check_case(state.shown, cases, "case");
  for (const int i : state.compared) check_case(i, cases, "compared case");
  for (const int i : state.selected) check_case(i, cases, "selected case");
  if (state.reference >= 0) check_case(state.reference, cases, "reference case");
}

}  // namespace

std::string absolute_path(const std::string& path) {
  return std::filesystem::absolute(path).lexically_normal().string();
}

void load_study(Session& session, const std::string& path) {
  Opened next;
  next.cases = std::make_shared<KnownCases>(path);
  next.state = state_at_first_case(session.state(), path, *next.cases);
  next.mesh = session.opened().mesh;
  session.opened() = std::move(next);
  session.edit().time = session.duration();
  session.changes().all();
  for (const std::string& notice : session.notices()) session.answer(notice);
}

void close_all(Session& session) {
  session.opened() = {};
  session.changes().all();
}

void restore(Session& session, const SessionState& state) {
  Opened next;
  next.state = state;
  next.state.playing = false;
  if (!state.study.empty()) {
    next.cases = std::make_shared<KnownCases>(state.study);
    next.state.study = absolute_path(state.study);
  }
  check_cases(state, next.cases ? next.cases->study().size() : 1);
  read_surfaces(session, next);
  session.opened() = std::move(next);
  follow_parameters(session);
  if (session.has_scene()) set_time(session, state.time);
  session.changes().all();
}

void set_time(Session& session, double t) {
  session.edit().time = std::clamp(t, 0., session.duration());
  session.changes().time = true;
}

void advance_time(Session& session, double seconds) {
  if (!session.has_scene()) return;
  SessionState& state = session.edit();
  const double end = session.duration();
  double t = state.time + state.speed * seconds;
  if (t >= end && state.loop && end > 0) {
    t = std::fmod(t, end);
  } else if (t >= end) {
    t = end;
    if (state.playing) state.playing = false, session.changes().playing = true;
  }
  state.time = t;
  session.changes().time = true;
}

}  // namespace cleft
