// Looking closer: single points, raw data, how the method works.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/output_file.h"
#include "base/text.h"
#include "explorer/session/commands.h"
#include "explorer/session/session.h"

namespace cleft {

namespace {

Vec3 read_place(Session& session, CommandWords& words) {
  const std::vector<double> x = words.numbers("a place U,V,W", 3, 3);
  const auto field = session.field();
  if (!field) words.wrong("no study is open (say: open DIR)");
  const char* axes[] = {"u", "v", "w"};
  for (int k = 0; k < 3; ++k)
    if (const Interval d = field->domain(k); x[k] < d.front - 1e-9 || x[k] > d.back + 1e-9)
      words.wrong(formatted("%s = %g is outside the patch, %g to %g mm", axes[k], x[k], d.front, d.back));
  return {x[0], x[1], x[2]};
}

/// Largest distance of the field from the simulation's node, over the frames.
double furthest(const Field& field, const ProbeState& probe, const Motion& motion) {
  double most = 0;
  for (std::size_t j = 0; j < motion.raw[0].x.size(); ++j) {
    const Vec3 raw{motion.raw[0].y[j], motion.raw[1].y[j], motion.raw[2].y[j]};
    most = std::max(most, norm(raw - field.displacement(*motion.node, probe.side, motion.raw[0].x[j])));
  }
  return most;
}

void probe(Session& session, CommandWords& words) {
  const std::string first = words.text("a place U,V,W, or clear");
  session.changes().closer = true;
  if (first == "clear") return session.edit().probe.reset();
  CommandWords place("probe", "U,V,W [left|right] [FILE.csv] | clear", {first});
  ProbeState point{read_place(session, place), Side::both};
  point.side = side_of(point.uvw.y);
  std::string word = words.empty() ? "" : words.text("a side or a file");
  if (word == "left" || word == "right") {
    const Side side = word == "left" ? Side::left : Side::right;
    if (point.side != Side::both && point.side != side)
      words.wrong(formatted("v = %g is on the other side of the cut", point.uvw.y));
    point.side = side;
    word = words.empty() ? "" : words.text("a file");
  } else if (point.side == Side::both && point.uvw.z > -session.field()->cut().depth) {
    point.side = Side::right;  // on the cut there are two points
  }
  session.edit().probe = point;
  const auto field = session.field();
  const Motion motion = session.probed_motion();
  if (!word.empty()) write_text_file(word, motion_as_csv(*field, point.uvw, point.side, motion));
  const Vec3 end = field->displacement(point.uvw, point.side, field->duration());
  session.answer(formatted("at the end it has moved by %.3f,%.3f,%.3f mm", end.x, end.y, end.z));
  if (motion.node)
    session.answer(
        formatted("the simulation's nearest node, %.2f,%.2f,%.2f, is plotted, %.2g mm from there: the "
                  "field is off by up to %.2g mm",
                  motion.node->x, motion.node->y, motion.node->z, norm(*motion.node - point.uvw),
                  furthest(*field, point, motion)));
  else
    session.answer(session.why_no_raw(session.state().shown));
}

void zoom(Session& session, CommandWords& words) {
  const std::string first = words.text("a place U,V,W, or off");
  session.changes().closer = session.changes().camera = true;
  if (first == "off") {
    session.edit().zoom.reset();
    session.edit().camera = {};
    return;
  }
  if (session.mesh()) words.wrong("the simulation is that of the patch (say: patch)");
  CommandWords place("zoom", "U,V,W [RADIUS] | off", {first});
  const Vec3 at = read_place(session, place);
  const double radius = words.empty() ? 5 : words.number_in("the radius", 0.1, 1000);
  const auto raw = session.raw_of(session.state().shown);
  if (raw->nodes_within(at, radius).empty())
    words.wrong(formatted("the simulation has no node within %g mm of this place", radius));
  session.edit().zoom = ZoomState{at, radius};
  constexpr double view_angle = 24;
  const double distance = 1.6 * radius / std::tan(view_angle / 2 * M_PI / 180);
  session.edit().camera.pose =
      CameraState::Pose{at + distance * normalized(Vec3{0, -0.45, 1}), at, {0, 1, 0}, view_angle};
  session.answer(session.overlay().caption);
}

void figure(Session& session, CommandWords& words) {
  const std::string name = words.text("constraints, lattice, volume or off");
  const std::vector<std::string>& names = overlay_figures();
  if (std::find(names.begin(), names.end(), name) == names.end())
    words.wrong("'" + name + "' is no figure" + did_you_mean(name, names));
  session.scene();  // says what is missing
  if (name == "volume" && !session.mesh()) words.wrong("there is no mesh with a cut (say: mesh FILE)");
  if ((name == "constraints" || name == "lattice") && session.mesh())
    words.wrong("it is that of the patch (say: patch)");
  if (name == "constraints") session.raw_of(session.state().shown);
  session.edit().figure = name == "off" ? "" : name;
  session.changes().closer = true;
}

/// Between places of the skin as it is now; they move with it.
void measure(Session& session, CommandWords& words) {
  constexpr std::size_t most = 100;  // places
  const std::string first = words.text("places X,Y,Z, add, or clear");
  session.changes().closer = true;
  std::vector<Vec3>& places = session.edit().ruler;
  if (first == "clear") {
    words.expect_end();
    return places.clear();
  }
  const auto add = [&](CommandWords& from) {
    if (places.size() == most) words.wrong("more than 100 places");
    const std::vector<double> x = from.numbers("a place X,Y,Z", 3, 3);
    places.push_back({x[0], x[1], x[2]});
  };
  if (first != "add") {
    CommandWords place("measure", "X,Y,Z X,Y,Z ... | add X,Y,Z | clear", {first});
    places.clear();
    add(place);
  }
  while (!words.empty()) add(words);
  const SkinRuler& ruler = session.ruler();
  const double t = std::min(session.state().time, ruler.scene()->duration());
  session.answer(places.size() < 2 ? "one place: add another to measure a distance"
                                   : told(ruler.at(t), ruler.at_rest()));
}

void tornado(Session& session, CommandWords&) {
  const Tornado t = session.tornado();
  session.answer(formatted("gape %.3g mm in the middle of the study; %s explains %.0f %% of its variance",
                           t.middle, t.logarithms ? "a power law" : "a plane", 100 * t.explained));
  for (const Tornado::Bar& b : t.bars)
    session.answer(formatted("%-28s %.4g to %.4g: gape %.3g to %.3g mm", b.parameter.c_str(), b.least,
                             b.greatest, b.at_least, b.at_greatest));
}

}  // namespace

std::span<const Command> closer_commands() {
  static const std::vector<Command> commands{
      {"probe", "U,V,W [left|right] [FILE.csv] | clear",
       "plot one point's motion, the simulation's node beside it", probe, Command::latest},
      {"zoom", "U,V,W [RADIUS] | off", "the simulation's nodes there, with the field's error at each", zoom},
      {"measure", "X,Y,Z X,Y,Z ... | add X,Y,Z | clear",
       "distances between places of the skin (at rest) as they move; the angle of three, the area of more",
       measure},
      {"figure", "constraints|lattice|volume|off",
       "how it works: constraints of the simulation, the spline's lattice, the blade's volume", figure},
      {"tornado", "", "what each parameter does to the gape", tornado, Command::none},
  };
  return commands;
}

}  // namespace cleft
