// cleft cut: cuts through one mesh, one after the other, without a window.
#include <algorithm>
#include <cstdio>
#include <memory>
#include <optional>

#include "base/command.h"
#include "base/error.h"
#include "base/h5.h"
#include "base/output_file.h"
#include "base/stopwatch.h"
#include "base/text.h"
#include "encoder/field/field_file.h"
#include "explorer/cut_figures.h"
#include "explorer/cut_volume.h"
#include "explorer/io/mesh_file.h"
#include "explorer/scene/path_file.h"
#include "explorer/scene/wounds.h"

namespace {

using namespace cleft;

struct Options {
  std::string mesh, field, out;
  std::vector<std::string> paths;
  bool rest = false, json = false;
  double scale = 1;                 // mm per mesh unit
  double depth = 0, progress = -1;  // mm; 0 and -1: not given
  std::optional<double> max_edge;   // mm
  std::vector<double> tension, prestress;
};

bool is_volume(const std::string& path) { return path.ends_with(".vtu"); }

/// One field, or three to be superposed.
struct Fields {
  std::optional<Field> one;
  std::unique_ptr<PrestressFields> turning;

  explicit Fields(const Options& options) {
    if (options.field.empty()) return;
    if (format_of(options.field) == "cleft-study")
      turning = std::make_unique<PrestressFields>(options.field);
    else
      one = read_field(options.field);
    if (one && !options.tension.empty())
      throw InputError(
          "--tension needs a study.dffd of three cases that differ in skin.prestress_u, _v and _uv alone; " +
          options.field + " is one case");
  }
  const Field* shape() const { return one ? &*one : turning ? &turning->shape() : nullptr; }

  VaryingField along(const Incision& cut, const std::string& path_file, const Options& options) const {
    const std::optional<PathPrestress> own = read_prestress(path_file, cut.path(), options.scale);
    if (one && own)
      throw FileError(path_file,
                      "has prestresses along the path: they need a study.dffd of three cases that differ in "
                      "skin.prestress_u, _v and _uv alone as --field");
    if (one) return *one;
    if (own) return turning->along(*own);
    if (options.tension.empty())
      throw InputError(
          options.field +
          " holds several cases: give --tension and --prestress, or the path columns skin.prestress_u, "
          "_v, _uv, or one case.dffd as --field");
    const double larger = std::max(options.prestress[0], options.prestress[1]),
                 smaller = std::min(options.prestress[0], options.prestress[1]);
    const Vec3 direction{options.tension[0], options.tension[1], options.tension[2]};
    const IncisionVolume volume(cut, turning->shape(), options.scale);
    return turning->along(prestress_along(volume, cut.path().length(), {direction, larger, smaller}));
  }
};

std::vector<PointArray> point_arrays(const std::vector<const Incision*>& cuts, const std::vector<Vec3>& moved,
                                     double scale) {
  PointArray displacement{"displacement", 3, {}}, depth{"depth", 1, {}}, region{"region", 1, {}},
      s{"s", 1, {}};
  const CutMesh& mesh = cuts.front()->mesh();
  for (std::size_t i = 0; i < moved.size(); ++i) {
    const CutMesh::Vertex& v = mesh.vertices()[i];
    const Vec3 d = moved[i] - v.position;
    displacement.values.insert(displacement.values.end(), {d.x, d.y, d.z});
    depth.values.push_back(v.depth * scale);
    region.values.push_back(v.depth_fraction == 0 ? 0 : side_of(v.kind) == Side::right ? 2 : 1);
    const bool on_cut = v.kind != VertexKind::skin;
    s.values.push_back(scale * (on_cut ? v.s : cuts.back()->path().coordinates(v.position).s));
  }
  return {displacement, depth, region, s};
}

void check_files(const Options& options) {
  if (is_volume(options.mesh) != is_volume(options.out))
    throw InputError("--mesh " + options.mesh + " and --out " + options.out +
                     ": a mesh of volume, .vtu, becomes a .vtu, and a surface a .vtp, .obj or .stl");
  if (!is_volume(options.out)) check_mesh_ending(options.out);  // a bad name is told before the work
  std::vector<std::string> inputs = options.paths;
  inputs.insert(inputs.end(), {options.mesh, options.field});
  refuse_to_overwrite(options.out, inputs);
  const OutputFile probe(options.out);
}

IncisionOptions incision_options(const Options& options, const ScalpelPath& path, const Field* field) {
  IncisionOptions result;
  if (options.max_edge && *options.max_edge > 0 && *options.max_edge < path.length() * options.scale / 1000)
    throw InputError("--max-edge " + shortest(*options.max_edge) +
                     ": at least a thousandth of the path's length, " +
                     shortest(path.length() * options.scale / 1000) + " mm");
  if (options.max_edge) result.max_edge = *options.max_edge / options.scale;
  if (field) result.reach = reach_of(*field, options.scale);
  return result;
}

/// Opens the cuts: positions of the mesh, and what is told of that.
std::unique_ptr<Wounds> open(const Options& options, const Fields& fields,
                             const std::vector<const Incision*>& cuts, double progress,
                             std::vector<Vec3>& positions, Json& figures) {
  std::vector<Wounds::Cut> wounds_of;
  for (std::size_t k = 0; k < cuts.size(); ++k)
    wounds_of.push_back({cuts[k], fields.along(*cuts[k], options.paths[k], options)});
  auto wounds = std::make_unique<Wounds>(std::move(wounds_of), options.scale);
  wounds->positions(progress, positions);  // the second frame is timed: memory is warm then
  const Stopwatch frame;
  wounds->positions(progress, positions);
  figures["frame_ms"] = 1e3 * frame.seconds();
  double largest = 0;
  for (std::size_t i = 0; i < positions.size(); ++i)
    largest = std::max(largest, norm(positions[i] - wounds->rest()[i]));
  figures["active_vertices"] = wounds->active();
  figures["largest_displacement_mm"] = largest * options.scale;
  figures["warnings"] = Json::array();
  const std::vector<bool> turned(cuts.size(), fields.turning != nullptr);
  const std::vector<Validity> validity = wounds->validity(turned);
  for (std::size_t k = 0; k < cuts.size(); ++k) {
    figures["cuts"][k].update(figures_of(validity[k]));
    for (const std::string& warning : validity[k].warnings) {
      std::fprintf(stderr, "cleft cut: warning: %s\n", warning.c_str());
      figures["warnings"].push_back(warning);
    }
  }
  return wounds;
}

void cut(const Options& options) {
  check_files(options);
  const Fields fields(options);
  MeshReport mesh_report;
  std::optional<VolumeMesh> volume;
  if (is_volume(options.mesh)) volume.emplace(options.mesh);
  const SurfaceMesh surface = volume ? volume->surface(&mesh_report) : read_mesh(options.mesh, &mesh_report);
  CutMesh mesh(surface);
  std::vector<std::unique_ptr<Incision>> incisions;
  std::vector<const Incision*> cuts;
  double progress = 0, cutting = 0, stepping = 0;
  for (const std::string& file : options.paths) {
    const ScalpelPath path = read_path(file, options.depth, options.scale, fields.shape());
    const IncisionOptions how = incision_options(options, path, fields.shape());
    const double length = path.length() * options.scale;
    const bool last = incisions.size() + 1 == options.paths.size();
    progress = options.progress < 0 || !last ? length : std::min(options.progress, length);
    Stopwatch watch;
    incisions.push_back(std::make_unique<Incision>(mesh, path, how));
    watch.lap();
    incisions.back()->advance_to(progress / options.scale);
    stepping += watch.lap(), cutting += watch.seconds();
    cuts.push_back(incisions.back().get());
  }
  SurfaceMesh result = mesh.surface();
  Json figures = figures_of(cuts, surface, options.scale);
  figures["mesh"] = figures_of(mesh_report);
  figures["cut_ms"] = 1e3 * cutting;
  figures["us_per_step"] = 1e6 * stepping / figures["steps"].get<double>();
  for (const Incision* one : cuts) figures["cuts"].push_back(figures_of(*one, options.scale));
  std::unique_ptr<Wounds> wounds;
  if (fields.shape()) wounds = open(options, fields, cuts, progress, result.points, figures);
  if (volume)
    figures["cells_added"] =
        write_cut_volume(*volume, surface, cuts, wounds.get(), options.scale, progress, options.out);
  else
    write_mesh(options.out, result, point_arrays(cuts, result.points, options.scale));
  print_figures(figures, options.json);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Cuts a mesh along paths, one after the other, and opens the cuts as a field says.",
               "cleft cut");
  Options o;
  app.add_option("--mesh", o.mesh, "surface mesh: .stl .obj .ply .vtp; or a mesh of volume: .vtu")
      ->required();
  app.add_option(
         "--path", o.paths,
         "CSV with columns x,y,z,nx,ny,nz[,depth][,skin.prestress_u,_v,_uv], in the mesh's units; again for "
         "further cuts")
      ->required();
  auto* field =
      app.add_option("--field", o.field,
                     "field file case.dffd that opens the cut; or study.dffd of three cases of other "
                     "prestress, for a tension that turns against the path");
  auto* rest = app.add_flag("--rest", o.rest, "leave the cut closed");
  field->excludes(rest);
  app.add_option("--out", o.out, "the cut mesh: .vtp (with point arrays) .obj .stl, or .vtu")->required();
  app.add_option("--depth", o.depth, "depth of the cut, mm [the path's column, else the field's]")
      ->check(above(0));
  app.add_option("--progress", o.progress, "how far the blade of the last cut has come, mm [the whole path]")
      ->check(at_least(0));
  auto* tension =
      app.add_option("--tension", o.tension, "X,Y,Z: direction of the skin's larger tension, in space")
          ->delimiter(',')
          ->expected(3);
  auto* prestress =
      app.add_option("--prestress", o.prestress, "LARGER,SMALLER: the skin's principal prestresses, MPa")
          ->delimiter(',')
          ->expected(2)
          ->check(at_least(0));
  tension->needs(prestress);
  prestress->needs(tension);
  app.add_option("--max-edge", o.max_edge,
                 "split longer edges near the path, mm; 0 leaves them [1/30 of the path]")
      ->check(at_least(0));
  app.add_option("--scale", o.scale, "mm per unit of the mesh")->check(above(0))->capture_default_str();
  app.add_flag("--json", o.json, "figures as JSON");
  return run_command(app, argc, argv, [&] {
    if (o.field.empty() && !o.rest) throw InputError("give --field case.dffd, or --rest for the closed cut");
    cut(o);
  });
}
