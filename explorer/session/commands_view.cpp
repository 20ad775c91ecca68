// Colours and camera.
#include "explorer/scene/color_maps.h"
#include "explorer/session/actions.h"
#include "explorer/session/commands.h"

namespace cleft {

namespace {

void color(Session& session, CommandWords& words) {
  const Coloring coloring = coloring_of(words.text("a colouring"), session.quantities());
  if (needs_reference(coloring) && session.state().reference < 0)
    words.wrong("from which case is not known (say: difference N)");
  color_by(session, coloring);
}

constexpr const char* range_usage = "LOW HIGH | LOW% HIGH% | auto";

void range(Session& session, CommandWords& words) {
  const std::string first = words.text("'auto' or two numbers");
  if (first == "auto") {
    session.edit().range.reset(), session.edit().percentiles.reset();
  } else {
    const std::string second = words.text("the upper end");
    const bool percent = first.ends_with("%");
    if (percent != second.ends_with("%")) words.wrong("both ends have a % or none has");
    const auto end_of = [&](const std::string& word, const char* what) {
      CommandWords one("range", range_usage, {percent ? word.substr(0, word.size() - 1) : word});
      return percent ? one.number_in(what, 0, 100) : one.number(what);
    };
    const double least = end_of(first, "the lower end"), greatest = end_of(second, "the upper end");
    if (least >= greatest) words.wrong("the lower end must be below the upper end");
    session.edit().range.reset(), session.edit().percentiles.reset();
    (percent ? session.edit().percentiles : session.edit().range) = {least, greatest};
  }
  session.changes().coloring = true;
}

void camera(Session& session, CommandWords& words) {
  CameraState& camera = session.edit().camera;
  camera = {words.number_in("the azimuth", -360, 360), words.number_in("the elevation", -360, 360),
            words.empty() ? 1 : words.number_in("the zoom", 0.1, 100), std::nullopt, std::nullopt};
  if (session.mesh() && !session.state().cuts.empty()) {
    const WoundSurface& surface = session.scene()->surface();
    camera.frame = CameraState::Frame{surface.middle, surface.outward, surface.along};
  }
  session.changes().camera = true;
}

Vec3 read_vec3(CommandWords& words, const std::string& what) {
  const std::vector<double> x = words.numbers(what, 3, 3);
  return {x[0], x[1], x[2]};
}

void look(Session& session, CommandWords& words) {
  CameraState::Pose pose;
  pose.position = read_vec3(words, "the camera's position");
  pose.focal_point = read_vec3(words, "the focal point");
  pose.up = read_vec3(words, "the direction up");
  pose.view_angle = words.empty() ? 24 : words.number_in("the view angle", 0.1, 170);
  if (pose.position == pose.focal_point) words.wrong("the camera stands in its focal point");
  if (norm(cross(pose.focal_point - pose.position, pose.up)) == 0) words.wrong("up is the direction of view");
  session.edit().camera.pose = pose;
  session.changes().camera = true;
}

void map(Session& session, CommandWords& words) {
  const std::string name = words.text("a colour map");
  try {
    session.edit().map = name == "auto" ? "" : color_map(name).name;
  } catch (const InputError& e) {
    words.wrong(e.what());
  }
  session.changes().coloring = true;
}

void warp(Session& session, CommandWords& words) {
  session.edit().warp = words.number_in("the factor", 0, 100);
  session.changes().coloring = true;
}

void edges(Session& session, CommandWords& words) {
  session.edit().edges = words.on_or_off();
  session.changes().coloring = true;
}

void shading(Session& session, CommandWords& words) {
  const std::string name = words.text("plain or skin");
  if (name != "plain" && name != "skin") words.wrong("'" + name + "' is neither plain nor skin");
  session.edit().lifelike = name == "skin";
  session.changes().coloring = true;
}

/// Across a cut, mm of its path from its start.
ClipState across_cut(Session& session, CommandWords& words) {
  const bool mesh = session.mesh() != nullptr;
  const int cuts = mesh ? static_cast<int>(session.state().cuts.size()) : 1;
  if (!session.has_scene() || cuts == 0) words.wrong("there is no cut yet");
  const int i = words.whole("the cut", 1, cuts) - 1;
  if (!mesh) {
    const CanonicalCut cut = session.field()->cut();
    const double s = words.number_in("the place along the cut, mm,", 0, cut.length);
    return {{cut.start + s, 0, 0}, {1, 0, 0}};
  }
  const ScalpelPath path = session.cut_paths()[static_cast<std::size_t>(i)];
  const PathFrame frame = path.at(words.number_in("the place along the cut, mm,", 0, path.length()));
  return {frame.position, frame.along};
}

void clip(Session& session, CommandWords& words) {
  const std::string first = words.text("a place, cut or off");
  session.changes().coloring = true;
  if (first == "off") return session.edit().clip.reset();
  if (first == "cut") return void(session.edit().clip = across_cut(session, words));
  CommandWords place("clip", "X,Y,Z DX,DY,DZ | cut N MM | off", {first});
  ClipState state{read_vec3(place, "a place"), read_vec3(words, "a direction")};
  if (!(norm(state.ahead) > 0)) words.wrong("the direction has no length");
  session.edit().clip = state;
}

void theme(Session& session, CommandWords& words) {
  const std::string name = words.text("light or dark");
  if (name != "light" && name != "dark") words.wrong("'" + name + "' is neither light nor dark");
  session.edit().dark = name == "dark";
  session.changes().look = true;
}

void detail(Session& session, CommandWords& words) {
  const std::string amount = words.text("micrometres, pixels or off");
  session.changes().detail = true;
  if (amount == "off") return session.edit().detail.reset();
  try {
    session.edit().detail = detail_of(amount);
  } catch (const InputError& e) {
    words.wrong(e.what());
  }
}

}  // namespace

std::span<const Command> view_commands() {
  static const std::string names = [] {
    std::string list;
    for (const ColoringText& c : colorings()) list += (list.empty() ? "" : "|") + c.name;
    return list;
  }();
  static const std::vector<Command> commands{
      {"color", names, "what the surface is coloured by; of imported data also QUANTITY, by its name", color},
      {"range", range_usage,
       "of the colours; with %: that part of all values of what moves is below; auto: from 0 to the largest "
       "of "
       "all times",
       range},
      {"map", "auto|" + color_map_names(), "of colours; auto: warm, and vik for what goes to both sides of 0",
       map},
      {"warp", "FACTOR", "displacements are drawn so many times as large as they are", warp, Command::latest},
      {"edges", "on|off", "the edges of the surface's triangles", edges},
      {"shading", "plain|skin",
       "skin: light as in skin and on wet wounds, with the shade of folds; colours of values stay as they "
       "are",
       shading},
      {"clip", "X,Y,Z DX,DY,DZ | cut N MM | off",
       "leave out what lies beyond a place in a direction, or beyond a place of cut N (of the patch: 1)",
       clip, Command::latest},
      {"camera", "AZIMUTH ELEVATION [ZOOM]",
       "degrees from the normal of the first cut at this moment; at zoom 1 all is seen", camera,
       Command::latest, true},
      {"look", "X,Y,Z FX,FY,FZ UX,UY,UZ [ANGLE]", "camera, the place it looks at, up, view angle", look,
       Command::latest, true},
      {"detail", "MICROMETRESum|PIXELSpx|off",
       "what a cut in a mesh never moves by more, like 10um or 0.25px, is not evaluated and stays at rest",
       detail, Command::latest},
      {"theme", "light|dark", "of window and pictures", theme},
  };
  return commands;
}

}  // namespace cleft
