// cleft cut: cuts through one mesh, one after the other, without a window.
#include <algorithm>
#include <memory>
#include <optional>

#include "base/command/command.h"
#include "base/error.h"
#include "base/output_file.h"
#include "base/stopwatch.h"
#include "base/text.h"
#include "explorer/commands/body_options.h"
#include "explorer/commands/cut_figures.h"
#include "explorer/commands/cut_simulated.h"
#include "explorer/commands/cut_volume.h"
#include "explorer/commands/mesh_options.h"
#include "explorer/commands/tension_options.h"
#include "explorer/incision/local_coordinates.h"
#include "explorer/incision/near_ends.h"
#include "explorer/io/formats/mesh_formats.h"
#include "explorer/io/mesh_file.h"
#include "explorer/wound/cut_fields.h"
#include "explorer/wound/mesh_cuts.h"
#include "explorer/wound/path_file.h"
#include "explorer/wound/replayed_wounds.h"

namespace {

using namespace cleft;

struct Options {
  std::string mesh, field, out;
  std::vector<std::string> paths;
  bool rest = false, json = false;
  double scale = 1;                 // mm per mesh unit
  double depth = 0, progress = -1;  // mm; 0 and -1: not given
  double detail = 0;                // micrometres
  std::optional<double> max_edge;   // mm
  TensionOptions tension;
  bool simulate = false;
  BodyOptions body;
};

bool is_volume(const std::string& path) { return is_mesh(path, MeshKind::volume); }

/// A surface, or a volume with its surface.
struct Skin {
  MeshReport report;
  std::optional<VolumeMesh> volume;
  SurfaceMesh surface;

  explicit Skin(const std::string& file) {
    if (is_volume(file)) volume.emplace(file);
    surface = volume ? volume->surface(&report) : read_mesh(file, &report);
  }
};

std::vector<PointArray> point_arrays(const MeshCuts& cuts, const std::vector<Vec3>& moved) {
  PointArray displacement{"displacement", 3, {}};
  for (std::size_t i = 0; i < moved.size(); ++i) {
    const Vec3 d = moved[i] - cuts.mesh().vertices()[i].position;
    displacement.values.insert(displacement.values.end(), {d.x, d.y, d.z});
  }
  return {displacement, {"depth", 1, cuts.depths()}, {"region", 1, cuts.regions()}, {"s", 1, cuts.along()}};
}

void check_files(const Options& options) {
  if (is_volume(options.mesh) != is_volume(options.out))
    throw InputError("--mesh " + options.mesh + " and --out " + options.out + ": a mesh of volume, " +
                     mesh_endings(MeshKind::volume, MeshUse::read) + ", becomes one, " +
                     mesh_endings(MeshKind::volume, MeshUse::write) + ", and a surface a surface, " +
                     mesh_endings(MeshKind::surface, MeshUse::write));
  if (!is_volume(options.out))
    surface_format(options.out, MeshUse::write);  // reports a bad name before the work
  std::vector<std::string> inputs = options.paths;
  inputs.insert(inputs.end(), {options.mesh, options.field, options.body.bone, options.body.case_file,
                               options.tension.lines, options.body.lines});
  std::erase(inputs, "");
  refuse_to_overwrite(options.out, inputs);
  const OutputFile probe(options.out);
}

/// `otherwise`: the depth of paths without one, mm.
std::vector<ScalpelPath> read_paths(const Options& options, std::optional<double> otherwise) {
  std::vector<ScalpelPath> paths;
  for (const std::string& file : options.paths)
    paths.push_back(read_path(file, options.depth, options.scale, otherwise));
  return paths;
}

/// A surface far from the origin is cut in coordinates from its cut.
std::unique_ptr<MeshCuts> make_cuts(const Options& options, const Skin& skin, const Field* field,
                                    const std::optional<BodyRequest>& simulated, Json& joined_ends) {
  std::optional<double> depth;
  if (simulated) depth = simulated->parameters.cut.depth;
  if (field) depth = field->cut().depth;
  auto [paths, ends] = with_near_ends_joined(read_paths(options, depth), narrowest_bridge / options.scale);
  joined_ends = told_of(ends, options.scale, "cleft cut");
  MeshCutsOptions how{options.scale, {}, options.max_edge};
  if (options.progress >= 0) how.progress = options.progress;
  const Vec3 origin = skin.volume ? Vec3{} : local_origin(skin.surface, paths.front());
  return std::make_unique<MeshCuts>(skin.surface, origin, paths, field, how);
}

std::unique_ptr<ReplayedWounds> open(const Options& options, const CutFields& fields, const MeshCuts& cuts) {
  std::vector<Wound> opened;
  for (std::size_t k = 0; k < cuts.cuts().size(); ++k) {
    const Incision& cut = *cuts.cuts()[k];
    const auto own = read_prestress(options.paths[k], cut.path().moved(cuts.origin()), options.scale);
    try {
      opened.push_back(fields.wound(cut, options.scale, own));
    } catch (const InputError& e) {
      throw FileError(options.paths[k], e.what());
    }
  }
  return std::make_unique<ReplayedWounds>(std::move(opened));
}

/// Moves the mesh as the wounds say, and tells of that.
void move(const ReplayedWounds& wounds, const CutFields& fields, const Options& options, double t,
          std::vector<Vec3>& positions, Json& figures) {
  std::optional<ReplayedWounds::Level> some;
  if (options.detail > 0) some = wounds.level(1e-3 * options.detail);
  const ReplayedWounds::Level& level = some ? *some : wounds.whole();
  wounds.positions(t, level, positions);  // the second frame is timed: memory is warm then
  const Stopwatch frame;
  wounds.positions(t, level, positions);
  figures["frame_ms"] = 1e3 * frame.seconds();
  double largest = 0;
  for (std::size_t i = 0; i < positions.size(); ++i)
    largest = std::max(largest, norm(positions[i] - wounds.rest()[i]));
  figures["active_vertices"] = level.active();
  figures["left_out_vertices"] = level.left_out();
  figures["left_out_at_most_mm"] = level.error;
  figures["largest_displacement_mm"] = largest * options.scale;
  const std::vector<Validity> validity = wounds.validity(fields.turning());
  for (std::size_t k = 0; k < validity.size(); ++k) figures["cuts"][k].update(figures_of(validity[k]));
  figures["warnings"] = warnings_of(validity, "cleft cut");
}

void cut(const Options& options) {
  check_files(options);
  const std::optional<SkinTension> tension = options.tension.read(options.scale);
  std::optional<CutFields> fields;
  if (!options.field.empty()) fields = read_cut_fields(options.field, tension);
  Skin skin(options.mesh);
  const Field* shape = fields ? &fields->shape() : nullptr;
  std::optional<BodyRequest> request;
  if (options.simulate) request = body_to_simulate(options.body, tension, fields, options.scale);
  warn_of_size(skin.surface, options.scale, shape, "cleft cut");
  tell_note(skin.surface, options.mesh, "cleft cut");
  Json joined_ends;
  const auto made = make_cuts(options, skin, shape, request, joined_ends);
  const MeshCuts& cuts = *made;
  SurfaceMesh result = cuts.mesh().surface();
  Json figures = figures_of(cuts.cuts(), cuts.uncut(), options.scale);
  figures["mesh"] = figures_of(skin.report);
  figures["joined_ends"] = std::move(joined_ends);
  figures["cut_ms"] = 1e3 * cuts.seconds();
  figures["us_per_step"] = 1e6 * cuts.stepping_seconds() / figures["steps"].get<double>();
  for (const Incision* one : cuts.cuts()) figures["cuts"].push_back(figures_of(*one, options.scale));
  if (request)
    for (TensionLine& line : request->tension) line.place -= options.scale * cuts.origin();
  std::unique_ptr<ReplayedWounds> wounds;
  const std::shared_ptr<const SurfaceIndex> bone = options.body.read_bone(options.scale, cuts.origin());
  if (fields) {
    if (bone) fields = fields->above_bone(distance_to(bone));
    if (tension) fields = fields->in_tension(*options.tension.read(options.scale, cuts.origin()));
    if (request) fields = in_tension_of(*request, *fields, options.paths, cuts);
    wounds = open(options, *fields, cuts);
    move(*wounds, *fields, options, cuts.progress(), result.points, figures);
  }
  if (request) {
    request->bone = bone;
    figures["simulated"] = move_as_simulated(std::move(*request), cuts, fields, result.points);
  }
  if (skin.volume) {
    figures["cells_added"] = write_cut_volume(*skin.volume, skin.surface, cuts.cuts(), wounds.get(),
                                              options.scale, cuts.progress(), options.out);
  } else {
    const auto arrays = point_arrays(cuts, result.points);
    result.colors = cuts.colors();
    write_mesh(options.out, moved(std::move(result), cuts.origin()), arrays);
  }
  print_figures(figures, options.json);
}

}  // namespace

int main(int argc, char** argv) {
  CommandLine app("Cuts a mesh along paths, one after the other, and opens the cuts as a field says.",
                  "cleft cut");
  Options o;
  app.add_option("--mesh", o.mesh,
                 "surface mesh: " + mesh_endings(MeshKind::surface, MeshUse::read) +
                     "; or a mesh of volume: " + mesh_endings(MeshKind::volume, MeshUse::read))
      ->required();
  app.add_option(
         "--path", o.paths,
         "CSV with columns x,y,z,nx,ny,nz[,depth][,skin.prestress_u,_v,_uv], in the mesh's units; again for "
         "further cuts")
      ->required();
  auto* field =
      app.add_option("--field", o.field,
                     "field file case.dffd that opens the cut; study.dffd of three cases of other "
                     "prestress, for a tension that turns against the path; or of a family, for the shape of "
                     "skin and blade too");
  auto* rest = app.add_flag("--rest", o.rest, "leave the cut closed");
  field->excludes(rest);
  app.add_option("--out", o.out,
                 "the cut mesh: " + mesh_endings(MeshKind::surface, MeshUse::write) + ", or of volume " +
                     mesh_endings(MeshKind::volume, MeshUse::write) +
                     "; with point arrays: " + mesh_endings_with_arrays())
      ->required();
  app.add_option("--depth", o.depth, "depth of the cut, mm [the path's column, else the field's]")
      ->check(above(0));
  app.add_option("--progress", o.progress, "how far the blade of the last cut has come, mm [the whole path]")
      ->check(at_least(0));
  o.tension.add_to(app);
  app.add_option("--max-edge", o.max_edge,
                 "split longer edges near the path, mm; 0 leaves them [1/30 of the path]")
      ->check(at_least(0));
  app.add_option("--detail", o.detail,
                 "vertices that the cuts never move by more than this many micrometres stay where they are")
      ->check(at_least(0))
      ->capture_default_str();
  add_scale(app, o.scale);
  app.add_flag(
         "--simulate", o.simulate,
         "open the cuts as a simulation of this very body says (seconds); with --field, tell how far the "
         "replay is from it")
      ->excludes(rest);
  o.body.add_to(app);
  app.add_flag("--json", o.json, "figures as JSON");
  return run_command(app, argc, argv, [&] {
    if (o.field.empty() && !o.rest && !o.simulate)
      throw InputError("give --field case.dffd, --simulate, or --rest for the closed cut");
    if (o.simulate && is_volume(o.mesh))
      throw InputError("--simulate, --mesh " + o.mesh +
                       ": a mesh of volume is not simulated yet; give its surface");
    if (const std::string option = o.body.first_given(!o.field.empty()); !o.simulate && !option.empty())
      throw InputError(option + ": is for --simulate" + (option == "--bone" ? " and --field" : ""));
    cut(o);
  });
}
