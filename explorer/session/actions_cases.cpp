// Which case is shown, what is interpolated between the cases, conditions and colours.
#include "base/error.h"
#include "base/text.h"
#include "explorer/session/actions.h"

namespace cleft {

namespace {

/// Why the state rules out that anything is interpolated; empty where it may be.
std::string why_not_between(const Opened& opened) {
  const SessionState& state = opened.state;
  if (!state.between) return "interpolation is off";
  if (!state.compared.empty()) return "cases are compared";
  if (state.tension) return "skin whose tension turns takes cases as they are";
  for (const auto& [name, range] : opened.cases->parameter_ranges())
    if (const auto requested = state.parameters.find(name);
        requested != state.parameters.end() &&
        (requested->second < range.first || requested->second > range.second))
      return name + " is outside the study, " + shortest(range.first) + " to " + shortest(range.second);
  return "";
}

/// The reader is kept, as what it has read is needed again.
Between nothing_between(const Opened& opened) {
  Between next;
  next.reader = opened.between.reader;
  return next;
}

Between make_between(Session& session, bool wait) {
  const Opened& opened = session.opened();
  Between next = nothing_between(opened);
  if (!opened.cases || session.shows_exactly()) return next;
  next.why_nearest = why_not_between(opened);
  if (!next.why_nearest.empty()) return next;
  const bool begun = !next.reader;
  if (begun) next.reader = std::make_shared<BetweenCases>(opened.cases->study().path());
  if (!wait && (begun || !next.reader->ready())) {
    next.preparing = true;
    next.why_nearest = "the cases are being read";
    return next;
  }
  try {
    next.reader->wait([&](double part) { session.progress("reading the cases", part); });
    next.field = next.reader->at(opened.state.parameters);
  } catch (const InputError& e) {
    next.why_nearest = e.what();
  }
  return next;
}

void show_at_its_time(Session& session) {
  follow_parameters(session);
  set_time(session, session.state().time);
  session.changes().shown = true;
}

}  // namespace

void follow_parameters(Session& session, bool wait) {
  session.opened().between = nothing_between(session.opened());  // while the cases are read
  session.opened().between = make_between(session, wait);
  session.opened().drawn.scenes.erase(session.state().shown);
  follow_cuts(session);
}

void follow_parameters(Session& session) { follow_parameters(session, !session.prepares_beside()); }

void show_case(Session& session, int i) {
  session.edit().parameters = session.cases().varying_parameters(i);
  session.edit().shown = i;
  show_at_its_time(session);
}

void request_parameter(Session& session, const std::string& parameter, double value) {
  session.edit().parameters[parameter] = value;
  session.edit().shown = session.cases().nearest(session.state().parameters);
  show_at_its_time(session);
}

void interpolate(Session& session, bool on) {
  session.edit().between = on;
  if (!on && session.preparing()) session.opened().between = {};  // ends the reading
  follow_parameters(session);
  if (session.has_scene()) set_time(session, session.state().time);
  session.changes().shown = true;
}

void finish_preparing(Session& session) {
  if (!session.preparing()) return;
  follow_parameters(session, true);
  set_time(session, session.state().time);
  session.changes().shown = true;
}

void find_cases(Session& session, const std::string& condition) {
  session.open_study();
  if (!condition.empty()) Condition{condition};  // says what is wrong with it
  session.edit().where = condition;
  session.changes().brushes = true;
}

void color_by(Session& session, const Coloring& coloring) {
  if (coloring == Coloring::own && (!session.mesh() || session.mesh()->colors.empty()))
    throw InputError(session.mesh()
                         ? "the mesh has no colours of its own; give a file with red, green and blue of each "
                           "point, or with a texture no finer than its triangles"
                         : "there is no mesh with colours of its own (say: mesh FILE)");
  if (coloring == Coloring::error) {
    if (session.mesh() && !session.opened().simulated.wounds)
      throw InputError(
          "errors are those of the patch that was simulated (say: patch), or of a replay against the "
          "simulation of its cuts (say: simulate on)");
    if (!session.mesh() && !session.own_mesh(session.state().shown)) session.raw_of(session.state().shown);
    session.opened().drawn.scenes.clear();  // made anew with what they are compared with
  }
  session.edit().coloring = coloring;
  session.edit().range.reset(), session.edit().percentiles.reset();
  session.changes().coloring = true;
}

}  // namespace cleft
