// The mesh and the cuts in it.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/output_file.h"
#include "base/text.h"
#include "explorer/io/formats/mesh_formats.h"
#include "explorer/session/actions.h"
#include "explorer/session/commands.h"
#include "explorer/wound/mesh_unit.h"
#include "explorer/wound/tissue_colors.h"
#include "haptic/devices/list.h"

namespace cleft {

namespace {

double read_unit(CommandWords& words) {
  const std::string word = words.text("mm, cm, dm, m, in, or mm in a unit");
  try {
    return mm_of_unit(word);
  } catch (const InputError& e) {
    words.wrong(e.what());
  }
}

void mesh(Session& session, CommandWords& words) {
  const std::string file = words.text("a mesh file");
  load_mesh(session, file, words.empty() ? 1 : read_unit(words));
}

void unit(Session& session, CommandWords& words) {
  const double mm = read_unit(words);
  if (!session.mesh()) throw InputError("there is no mesh whose unit it could be (say: mesh FILE)");
  load_mesh(session, session.state().mesh, mm);
}

void bone(Session& session, CommandWords& words) {
  const std::string file = words.text("a mesh file, or none");
  put_bone(session, file == "none" ? "" : file);
}

void patch(Session& session, CommandWords&) { show_patch(session); }

/// Points in mm; `depth N` at the end is for all that have none of their own.
CutState read_cut(CommandWords& words) {
  CutState cut;
  while (!words.empty()) {
    const std::string word = words.text("a point");
    if (word == "depth") {
      const double depth = words.number_in("the depth", 1e-3, 1e3);
      for (ScalpelPath::Point& p : cut.points)
        if (p.depth <= 0) p.depth = depth;
      break;
    }
    CommandWords point("cut", "X,Y,Z,NX,NY,NZ[,DEPTH] ... [depth MM]", {word});
    const std::vector<double> x = point.numbers("a point", 6, 7);
    cut.points.push_back({{x[0], x[1], x[2]}, {x[3], x[4], x[5]}, x.size() > 6 ? x[6] : 0});
  }
  if (cut.points.size() < 2) words.wrong("a cut needs two points");
  return cut;
}

void cut(Session& session, CommandWords& words) { add_cut(session, read_cut(words)); }
void recut(Session& session, CommandWords& words) { replace_last_cut(session, read_cut(words)); }

/// From 0.
std::size_t read_cut_number(Session& session, CommandWords& words) {
  const int count = static_cast<int>(session.state().cuts.size());
  if (!session.mesh() || count == 0) throw InputError("there is no cut yet (say: cut ...)");
  return static_cast<std::size_t>(words.whole("the cut", 1, count) - 1);
}

void edit(Session& session, CommandWords& words) {
  const std::size_t index = read_cut_number(session, words);
  CutEdit edit;
  do {
    const std::string what = words.text("point, reach, depth or tilt");
    if (what == "point") {
      const int count = static_cast<int>(session.state().cuts[index].points.size());
      const int point = words.whole("the point", 1, count) - 1;
      const std::vector<double> x = words.numbers("a place X,Y,Z", 3, 3);
      edit.moves.push_back({point, {x[0], x[1], x[2]}});
    } else if (what == "reach") {
      edit.reach = words.number_in("the reach", 0, 1e3);
    } else if (what == "depth") {
      edit.depth = words.number_in("the depth", 0, 1e3);
      if (*edit.depth > 0 && *edit.depth < 1e-3)
        words.wrong("the depth is 0 (the case's), or 0.001 mm or more");
    } else if (what == "tilt") {
      edit.tilt = words.number_in("the tilt", -CutEdit::steepest, CutEdit::steepest);
    } else {
      words.wrong("'" + what + "' is neither point, reach, depth nor tilt");
    }
  } while (!words.empty());
  edit_cut(session, index, edit);
}

void handles(Session& session, CommandWords& words) {
  const std::string first = words.text("a cut, or off");
  session.changes().closer = true;
  if (first == "off") {
    session.edit().handled = -1;
    return;
  }
  CommandWords number("handles", "N | off", {first});
  session.edit().handled = static_cast<int>(read_cut_number(session, number));
  session.handles();  // says where there are none
}

void cut_file(Session& session, CommandWords& words) {
  const std::string file = words.text("a path file");
  const NumberTable table = read_csv(file);
  ScalpelPath::from_table(table, file);  // says what is wrong with it
  const double scale = session.state().scale;
  const int depth = table.column("depth");
  CutState cut;
  for (const std::vector<double>& row : table.rows) {
    const auto at = [&](const char* name) { return row[table.column(name)]; };
    cut.points.push_back({scale * Vec3{at("x"), at("y"), at("z")},
                          {at("nx"), at("ny"), at("nz")},
                          depth < 0 ? 0 : scale * row[depth]});
  }
  add_cut(session, cut);
}

void device(Session& session, CommandWords& words) {
  const std::string name = words.text("a device, or off");
  const std::string file = words.empty() ? "" : words.text("a file");
  words.expect_end();
  if (!session.services().device)
    throw InputError(
        "a haptic device is felt in the window: begin cleft explore without --script and --screenshot; "
        "without a window there is cleft haptic");
  if (name != "off" && !session.mesh()) throw InputError("there is no mesh to cut (say: mesh FILE)");
  session.services().device(name, file);
}

void tension(Session& session, CommandWords& words) {
  const std::string first = words.text("a direction, a file of lines, or none");
  if (first == "none") return set_tension(session, std::nullopt);
  SkinTension tension;
  if (first.ends_with(".csv")) {
    tension.lines =
        std::make_shared<const std::vector<TensionLine>>(read_tension_lines(first, session.state().scale));
    tension.direction = tension.lines->front().direction;
  } else {
    CommandWords direction("tension", "X,Y,Z", {first});
    const std::vector<double> x = direction.numbers("a direction", 3, 3);
    if (!(std::hypot(x[0], x[1], x[2]) > 0)) words.wrong("the direction of a tension has a length");
    tension.direction = {x[0], x[1], x[2]};
  }
  const std::vector<double> p = words.numbers("the larger and the smaller prestress", 2, 2);
  if (!(std::min(p[0], p[1]) >= 0)) words.wrong("a prestress is not below 0 MPa");
  tension.larger = std::max(p[0], p[1]), tension.smaller = std::min(p[0], p[1]);
  set_tension(session, tension);
}

/// The first stroke takes the prestresses of the shown case.
void paint_tension(Session& session, CommandWords& words) {
  std::vector<Vec3> places;
  while (!words.empty()) {
    const std::vector<double> x = words.numbers("a place", 3, 3);
    places.push_back({x[0], x[1], x[2]});
  }
  SkinTension tension;
  if (session.state().tension) {
    tension = *session.state().tension;
  } else {
    const Prestress of_case = prestress_of(session.open_study().parameters(session.state().shown));
    tension.larger = std::max(of_case.uu, of_case.vv), tension.smaller = std::min(of_case.uu, of_case.vv);
  }
  std::vector<TensionLine> lines;
  if (tension.lines) lines = *tension.lines;
  const std::size_t before = lines.size();
  for (std::size_t i = 1; i < places.size(); ++i)
    if (const Vec3 way = places[i] - places[i - 1]; norm(way) > 0)
      lines.push_back({0.5 * (places[i] + places[i - 1]), way});
  if (lines.size() == before) words.wrong("a stroke has two places");
  tension.direction = lines.front().direction;
  tension.lines = std::make_shared<const std::vector<TensionLine>>(std::move(lines));
  set_tension(session, tension);
}

/// Without an exponent.
std::string three_digits(double value) {
  return std::abs(value) < 1000 ? formatted("%.3g", value) : formatted("%.0f", 10 * std::round(value / 10));
}

void wounds(Session& session, CommandWords& words) {
  const std::string file = words.empty() ? "" : words.text("a file .csv");
  words.expect_end();
  if (!session.mesh() || session.state().cuts.empty()) throw InputError("there is no cut yet (say: cut ...)");
  const std::vector<WoundFigures> all = session.scene()->wound_figures(session.state().time);
  const std::vector<Validity>& validity = session.validity();
  std::string csv = "cut,length,depth,opening,opening_error,opening_at,area,volume\n";
  for (std::size_t i = 0; i < all.size(); ++i) {
    const WoundFigures& f = all[i];
    const double error = i < validity.size() ? validity[i].expected_error.largest * f.widest : std::nan("");
    session.answer(
        formatted("cut %zu: %.1f mm long, %.2g mm deep; opens by up to %.2f", i + 1, f.length, f.depth,
                  f.widest) +
        (i < validity.size() ? formatted(" +- %.2g", error) : "") +
        formatted(" mm, at %.1f mm; %s mm2 between its lips, %s mm3 between its walls", f.widest_at,
                  three_digits(f.area).c_str(), three_digits(f.volume).c_str()) +
        (i < validity.size() ? "; mostly uncertain because " + validity[i].expected_error.cause : ""));
    csv += std::to_string(i + 1);
    for (const double value : {f.length, f.depth, f.widest, error, f.widest_at, f.area, f.volume})
      csv += "," + (std::isfinite(value) ? shortest(value) : std::string());
    csv += "\n";
  }
  if (!file.empty()) write_text_file(file, csv);
}

void look_at_wound(Session& session, CommandWords& words) {
  const ScalpelPath path = session.cut_paths()[read_cut_number(session, words)];
  const PathFrame middle = path.at(path.length() / 2);
  constexpr double view_angle = 24, room = 1.4;
  const double distance = room * path.length() / 2 / std::tan(view_angle / 2 * M_PI / 180);
  const Vec3 up = std::abs(middle.outward.y) < 0.9 ? Vec3{0, 1, 0} : middle.along;
  session.edit().camera.pose =
      CameraState::Pose{middle.position + distance * middle.outward, middle.position, up, view_angle};
  session.changes().camera = true;
}

void simulate(Session& session, CommandWords& words) { simulate_cuts(session, words.on_or_off()); }

bool read_any(CommandWords& words) {
  if (words.empty()) return false;
  if (const std::string word = words.text("any"); word != "any") words.wrong("'" + word + "' is not any");
  return true;
}

void undo(Session& session, CommandWords& words) {
  read_any(words) ? session.take_back_line() : undo_last(session);
}
void redo(Session& session, CommandWords& words) {
  read_any(words) ? session.make_line_again() : redo_last(session);
}

void export_mesh(Session& session, CommandWords& words) {
  const std::string file = words.text("a file " + mesh_endings(MeshKind::surface, MeshUse::write));
  words.expect_end();
  const auto scene = session.scene();
  SurfaceMesh out;
  scene->positions(session.state().time, out.points);
  for (Vec3& x : out.points) x *= 1 / session.state().scale;
  out.triangles = scene->surface().triangles;
  out.colors = with_tissue(scene->surface().colors, scene->surface().depth_fraction);
  session.services().write_mesh(file, out);
}

}  // namespace

std::span<const Command> cut_commands() {
  static const std::vector<Command> commands{
      {"mesh", "FILE [mm|cm|dm|m|in|MM_PER_UNIT]",
       "a surface mesh to cut, and its unit [mm]: " + mesh_endings(MeshKind::surface, MeshUse::read), mesh},
      {"unit", "mm|cm|dm|m|in|MM_PER_UNIT", "read the mesh again, in this unit, without cuts", unit},
      {"wounds", "[FILE.csv]",
       "length, depth, opening with its expected error, area and volume of each cut, and why it is uncertain",
       wounds, Command::none},
      {"wound", "N", "look at cut N", look_at_wound, Command::all, true},
      {"bone", "FILE | none",
       "the surface of the bone below the mesh, in the mesh's units: families of fields open cuts by it",
       bone},
      {"patch", "", "back to the patch that was simulated", patch},
      {"cut", "X,Y,Z,NX,NY,NZ[,DEPTH] ... [depth MM]", "cut along places with outward normals, mm", cut},
      {"recut", "X,Y,Z,NX,NY,NZ[,DEPTH] ... [depth MM]", "the last cut goes there instead", recut,
       Command::latest},
      {"edit-cut", "N [point I X,Y,Z]... [reach MM] [depth MM] [tilt DEGREES]",
       "change cut N: points of its path are moved over the skin, those within the reach follow; depth of "
       "its deepest place (0: the case's); lean to its left",
       edit},
      {"handles", "N | off", "balls that change cut N when they are dragged: its path, depth and tilt",
       handles, Command::all, true},
      {"cut-file", "PATH.csv", "cut along a path file: x,y,z,nx,ny,nz[,depth], in the mesh's units",
       cut_file},
      {"device", "NAME [FILE] | off",
       "cut with a haptic device: " + device_usages() + ", or the name of a plug-in", device, Command::none},
      {"tension", "X,Y,Z|LINES.csv LARGER,SMALLER | none",
       "the skin's tension, prestresses in MPa, and the direction of the larger, or lines x,y,z,dx,dy,dz of "
       "it: "
       "cuts turn against it",
       tension},
      {"tension-stroke", "X,Y,Z X,Y,Z ...",
       "a line of the larger tension over the skin, besides those before", paint_tension},
      {"simulate", "on | off",
       "simulate the cuts in this very mesh, each time that they change, and show them so", simulate},
      {"undo", "[any]",
       "take the last cut, change of a cut, or tension back; any: what the last line has changed, except "
       "time and camera",
       undo},
      {"redo", "[any]", "make it again", redo},
      {"export", "FILE",
       "write the surface as it is shown, in the mesh's units: " +
           mesh_endings(MeshKind::surface, MeshUse::write),
       export_mesh, Command::none},
  };
  return commands;
}

}  // namespace cleft
