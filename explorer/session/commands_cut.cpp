// The mesh and the cuts in it.
#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "explorer/io/formats/mesh_formats.h"
#include "explorer/session/actions.h"
#include "explorer/session/commands.h"
#include "haptic/devices/list.h"

namespace cleft {

namespace {

void mesh(Session& session, CommandWords& words) {
  const std::string file = words.text("a mesh file");
  load_mesh(session, file, words.empty() ? 1 : words.number_in("mm per unit", 1e-6, 1e6));
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
  const std::string first = words.text("a direction, or none");
  if (first == "none") return set_tension(session, std::nullopt);
  CommandWords direction("tension", "X,Y,Z", {first});
  const std::vector<double> x = direction.numbers("a direction", 3, 3),
                            p = words.numbers("the larger and the smaller prestress", 2, 2);
  if (!(std::hypot(x[0], x[1], x[2]) > 0)) words.wrong("the direction of a tension has a length");
  if (!(std::min(p[0], p[1]) >= 0)) words.wrong("a prestress is not below 0 MPa");
  set_tension(session, SkinTension{{x[0], x[1], x[2]}, std::max(p[0], p[1]), std::min(p[0], p[1])});
}

void simulate(Session& session, CommandWords& words) { simulate_cuts(session, words.on_or_off()); }

void undo(Session& session, CommandWords&) { undo_last(session); }
void redo(Session& session, CommandWords&) { redo_last(session); }

void export_mesh(Session& session, CommandWords& words) {
  const std::string file = words.text("a file " + mesh_endings(MeshKind::surface, MeshUse::write));
  words.expect_end();
  const auto scene = session.scene();
  SurfaceMesh out;
  scene->positions(session.state().time, out.points);
  for (Vec3& x : out.points) x *= 1 / session.state().scale;
  out.triangles = scene->surface().triangles;
  session.services().write_mesh(file, out);
}

}  // namespace

std::span<const Command> cut_commands() {
  static const std::vector<Command> commands{
      {"mesh", "FILE [MM_PER_UNIT]",
       "a surface mesh to cut: " + mesh_endings(MeshKind::surface, MeshUse::read), mesh},
      {"bone", "FILE | none",
       "the surface of the bone below the mesh, in the mesh's units: families of fields open cuts by it",
       bone},
      {"patch", "", "back to the patch that was simulated", patch},
      {"cut", "X,Y,Z,NX,NY,NZ[,DEPTH] ... [depth MM]", "cut along places with outward normals, mm", cut},
      {"recut", "X,Y,Z,NX,NY,NZ[,DEPTH] ... [depth MM]", "the last cut goes there instead", recut,
       Command::latest},
      {"cut-file", "PATH.csv", "cut along a path file: x,y,z,nx,ny,nz[,depth], in the mesh's units",
       cut_file},
      {"device", "NAME [FILE] | off",
       "cut with a haptic device: " + device_usages() + ", or the name of a plug-in", device, Command::none},
      {"tension", "X,Y,Z LARGER,SMALLER | none",
       "the skin's larger tension and its direction, prestresses in MPa: cuts turn against it", tension},
      {"simulate", "on | off",
       "simulate the cuts in this very mesh, each time that they change, and show them so", simulate},
      {"undo", "", "take the last cut or tension back", undo},
      {"redo", "", "make it again", redo},
      {"export", "FILE",
       "write the surface as it is shown, in the mesh's units: " +
           mesh_endings(MeshKind::surface, MeshUse::write),
       export_mesh, Command::none},
  };
  return commands;
}

}  // namespace cleft
