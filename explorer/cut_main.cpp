// cleft cut: one cut through one surface mesh, without a window.
#include <algorithm>
#include <optional>

#include "base/command.h"
#include "base/error.h"
#include "base/output_file.h"
#include "base/stopwatch.h"
#include "base/text.h"
#include "encoder/field/field_file.h"
#include "explorer/incision/incision.h"
#include "explorer/incision/triangle_quality.h"
#include "explorer/io/mesh_file.h"
#include "explorer/scene/path_file.h"
#include "explorer/scene/replay.h"

namespace {

using namespace cleft;

struct Options {
  std::string mesh, path, field, out;
  bool rest = false, json = false;
  double scale = 1;                 // mm per mesh unit
  double depth = 0, progress = -1;  // mm; 0 and -1: not given
  std::optional<double> max_edge;   // mm
};

std::vector<PointArray> point_arrays(const Incision& incision, const std::vector<Vec3>& moved, double scale) {
  PointArray displacement{"displacement", 3, {}}, depth{"depth", 1, {}}, region{"region", 1, {}},
      s{"s", 1, {}};
  const CutMesh& mesh = incision.mesh();
  for (std::size_t i = 0; i < moved.size(); ++i) {
    const CutMesh::Vertex& v = mesh.vertices()[i];
    const Vec3 d = moved[i] - v.position;
    displacement.values.insert(displacement.values.end(), {d.x, d.y, d.z});
    const bool on_cut = v.kind != VertexKind::skin;
    depth.values.push_back(on_cut ? v.depth_fraction * incision.path().depth(v.s) * scale : 0);
    region.values.push_back(v.depth_fraction == 0 ? 0 : side_of(v.kind) == Side::right ? 2 : 1);
    s.values.push_back(scale * (on_cut ? v.s : incision.path().coordinates(v.position).s));
  }
  return {displacement, depth, region, s};
}

Json figures_of(const MeshReport& m) {
  return {{"points", m.points},
          {"triangles", m.triangles},
          {"components", m.components},
          {"boundary_edges", m.boundary_edges},
          {"non_manifold_edges", m.non_manifold_edges},
          {"non_manifold_vertices", m.non_manifold_vertices},
          {"inside_out_components", m.inside_out_components},
          {"merged_points", m.merged_points},
          {"degenerate_triangles_left_out", m.degenerate_triangles},
          {"duplicate_triangles_left_out", m.duplicate_triangles},
          {"triangles_turned", m.turned_triangles}};
}

struct Size {
  double skin_area = 0, volume = 0;
};

Size size_of(const CutMesh& mesh) {
  Size size;
  for (const CutMesh::Triangle& t : mesh.triangles()) {
    const Vec3 &a = mesh.position(t.vertex[0]), &b = mesh.position(t.vertex[1]),
               &c = mesh.position(t.vertex[2]);
    size.volume += dot(a, cross(b, c)) / 6;
    if (t.region == Region::skin) size.skin_area += norm(cross(b - a, c - a)) / 2;
  }
  return size;
}

/// At rest, before the field opens the cut.
Json figures_of(const Incision& incision, const SurfaceMesh& surface, const SurfaceMesh& result,
                double scale) {
  const CutMesh uncut(surface);
  const Size before = size_of(uncut), after = size_of(incision.mesh());
  const auto& triangles = incision.mesh().triangles();
  const auto walls = std::count_if(triangles.begin(), triangles.end(),
                                   [](const CutMesh::Triangle& t) { return t.region != Region::skin; });
  return {{"triangles_before", surface.triangles.size()},
          {"triangles_after", result.triangles.size()},
          {"triangles_added", result.triangles.size() - surface.triangles.size()},
          {"wall_triangles", walls},
          {"steps", incision.chain().size()},
          {"cut_length_mm", (incision.tip() - incision.start()) * scale},
          {"chord_error_mm", incision.chord_error() * scale},
          {"worst_quality_before", smallest_radius_ratio(uncut)},
          {"worst_quality_after", smallest_radius_ratio(incision.mesh())},
          {"skin_area_change_mm2", (after.skin_area - before.skin_area) * scale * scale},
          {"volume_change_mm3", (after.volume - before.volume) * scale * scale * scale}};
}

void cut(const Options& options) {
  check_mesh_ending(options.out);  // a bad name is told before the work
  refuse_to_overwrite(options.out, {options.mesh, options.path, options.field});
  const OutputFile probe(options.out);
  std::optional<Field> field;
  if (!options.field.empty()) field = read_field(options.field);
  MeshReport mesh_report;
  const SurfaceMesh surface = read_mesh(options.mesh, &mesh_report);
  const ScalpelPath path = read_path(options.path, options.depth, options.scale, field ? &*field : nullptr);

  Stopwatch watch;
  IncisionOptions incision_options;
  if (options.max_edge && *options.max_edge > 0 && *options.max_edge < path.length() * options.scale / 1000)
    throw InputError("--max-edge " + shortest(*options.max_edge) +
                     ": at least a thousandth of the path's length, " +
                     shortest(path.length() * options.scale / 1000) + " mm");
  if (options.max_edge) incision_options.max_edge = *options.max_edge / options.scale;
  Incision incision(surface, path, incision_options);
  const double length = path.length() * options.scale;
  const double progress = options.progress < 0 ? length : std::min(options.progress, length);
  watch.lap();
  incision.advance_to(progress / options.scale);
  const double stepping = watch.lap(), cutting = watch.seconds();

  SurfaceMesh result = incision.mesh().surface();
  Json figures = figures_of(incision, surface, result, options.scale);
  figures["mesh"] = figures_of(mesh_report);
  figures["cut_ms"] = 1e3 * cutting;
  figures["us_per_step"] = 1e6 * stepping / static_cast<double>(incision.chain().size());
  if (field) {
    const Replay replay(*field, incision, options.scale);
    replay.positions(progress, result.points);  // the second frame is timed: memory is warm then
    const Stopwatch frame;
    replay.positions(progress, result.points);
    figures["frame_ms"] = 1e3 * frame.seconds();
    double largest = 0;
    for (std::size_t i = 0; i < result.points.size(); ++i)
      largest = std::max(largest, norm(result.points[i] - replay.rest()[i]));
    figures["active_vertices"] = replay.active().size();
    figures["largest_displacement_mm"] = largest * options.scale;
  }
  write_mesh(options.out, result, point_arrays(incision, result.points, options.scale));
  print_figures(figures, options.json);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Cuts a surface mesh along a path and opens it as a field says.", "cleft cut");
  Options o;
  app.add_option("--mesh", o.mesh, "surface mesh: .stl .obj .ply .vtp")->required();
  app.add_option("--path", o.path, "CSV with columns x,y,z,nx,ny,nz[,depth], in the mesh's units")
      ->required();
  auto* field = app.add_option("--field", o.field, "field file case.dffd that opens the cut");
  auto* rest = app.add_flag("--rest", o.rest, "leave the cut closed");
  field->excludes(rest);
  app.add_option("--out", o.out, "the cut mesh: .vtp (with point arrays) .obj .stl")->required();
  app.add_option("--depth", o.depth, "depth of the cut, mm [the path's column, else the field's]")
      ->check(above(0));
  app.add_option("--progress", o.progress, "how far the blade has come, mm [the whole path]")
      ->check(at_least(0));
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
