// Colours and camera.
#include "explorer/session/actions.h"
#include "explorer/session/commands.h"

namespace cleft {

namespace {

void color(Session& session, CommandWords& words) {
  const Coloring coloring = coloring_of(words.text("a colouring"), session.quantities());
  if (coloring == Coloring::difference && session.state().reference < 0)
    words.wrong("from which case is not known (say: difference N)");
  color_by(session, coloring);
}

void range(Session& session, CommandWords& words) {
  const std::string first = words.text("'auto' or two numbers");
  if (first == "auto") {
    session.edit().range.reset();
  } else {
    CommandWords low("range", "LOW HIGH | auto", {first});
    const double least = low.number("the lower end"), greatest = words.number("the upper end");
    if (least >= greatest) words.wrong("the lower end must be below the upper end");
    session.edit().range = {least, greatest};
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
      {"range", "LOW HIGH | auto", "of the colours; auto: from 0 to the largest of all times", range},
      {"camera", "AZIMUTH ELEVATION [ZOOM]",
       "degrees from the normal of the first cut at this moment; at zoom 1 all is seen", camera,
       Command::latest},
      {"look", "X,Y,Z FX,FY,FZ UX,UY,UZ [ANGLE]", "camera, the place it looks at, up, view angle", look,
       Command::latest},
      {"detail", "MICROMETRESum|PIXELSpx|off",
       "what a cut in a mesh never moves by more, like 10um or 0.25px, is not evaluated and stays at rest",
       detail, Command::latest},
      {"theme", "light|dark", "of window and pictures", theme},
  };
  return commands;
}

}  // namespace cleft
