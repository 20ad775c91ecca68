#include "explorer/commands/cut_figures.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "explorer/incision/triangle_quality.h"
#include "explorer/wound/mesh_unit.h"
#include "params/parameters/parameters.h"

namespace cleft {

namespace {

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

/// JSON knows no infinity.
Json finite(double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); }

constexpr std::size_t most_named = 20;  // triangles

Json named(const std::vector<Validity::Unsound>& unsound) {
  Json all = Json::array();
  for (std::size_t i = 0; i < std::min(unsound.size(), most_named); ++i) {
    const auto& [at, place, blade_in, blade_at, torn] = unsound[i];
    all.push_back({{"is", torn ? "torn" : "turned over"},
                   {"at_mm", at},
                   {"place", {place.x, place.y, place.z}},
                   {"blade_in_cut", blade_in + 1},
                   {"blade_at_mm", blade_at}});
  }
  return all;
}

}  // namespace

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

Json figures_of(const std::vector<const Incision*>& cuts, const SurfaceMesh& before, double scale) {
  const CutMesh uncut(before);
  const CutMesh& mesh = cuts.front()->mesh();
  const Size was = size_of(uncut), is = size_of(mesh);
  const auto walls = std::count_if(mesh.triangles().begin(), mesh.triangles().end(),
                                   [](const CutMesh::Triangle& t) { return t.region != Region::skin; });
  std::size_t steps = 0;
  double length = 0, chord_error = 0;
  for (const Incision* cut : cuts) {
    steps += cut->chain().size();
    length += cut->tip() - cut->start();
    chord_error = std::max(chord_error, cut->chord_error());
  }
  return {{"triangles_before", before.triangles.size()},
          {"triangles_after", mesh.triangles().size()},
          {"triangles_added", mesh.triangles().size() - before.triangles.size()},
          {"wall_triangles", walls},
          {"steps", steps},
          {"cut_length_mm", length * scale},
          {"chord_error_mm", chord_error * scale},
          {"worst_quality_before", smallest_radius_ratio(uncut)},
          {"worst_quality_after", smallest_radius_ratio(mesh)},
          {"skin_area_change_mm2", (is.skin_area - was.skin_area) * scale * scale},
          {"volume_change_mm3", (is.volume - was.volume) * scale * scale * scale}};
}

Json figures_of(const Incision& cut, double scale) {
  return {{"cut_length_mm", (cut.tip() - cut.start()) * scale},
          {"chord_error_mm", cut.chord_error() * scale}};
}

Json figures_of(const Validity& v) {
  return {{"smallest_radius_mm", finite(v.smallest_radius)},
          {"largest_tilt_degrees", v.largest_tilt},
          {"length_defect", finite(v.length_defect)},
          {"nearest_cut_mm", finite(v.nearest_cut)},
          {"held_back_mm", v.held_back},
          {"held_back_at_mm", v.held_back_at},
          {"guarded_vertices", v.guarded_vertices},
          {"guarded_mm", v.guarded},
          {"guarded_at_mm", v.guarded_at},
          {"unsound_triangles", v.unsound.size()},
          {"unsound", named(v.unsound)},
          {"expected_opening_error", v.expected_error.largest},
          {"expected_opening_error_at_mm", v.expected_error.at},
          {"expected_opening_error_because", v.expected_error.cause},
          {"junction_tension", v.junction_tension ? finite(*v.junction_tension) : Json()}};
}

Json told_of(const std::vector<JoinedEnd>& ends, double scale, const char* command) {
  Json list = Json::array();
  for (const JoinedEnd& one : ends) {
    list.push_back({{"cut", one.cut + 1},
                    {"other", one.other + 1},
                    {"end", one.start ? "start" : "end"},
                    {"gap_mm", one.gap * scale}});
    std::fprintf(stderr, "%s: note: cut %d %s %.3g mm from cut %d: it is led on to it\n", command,
                 one.cut + 1, one.start ? "begins" : "ends", one.gap * scale, one.other + 1);
  }
  return list;
}

void print_warnings(const Json& warnings, const char* command) {
  for (const Json& warning : warnings)
    std::fprintf(stderr, "%s: warning: %s\n", command, warning.get<std::string>().c_str());
}

Json warnings_of(const std::vector<Validity>& validity, const char* command) {
  Json warnings = Json::array();
  for (const Validity& v : validity)
    for (const std::string& warning : v.warnings) warnings.push_back(warning);
  print_warnings(warnings, command);
  return warnings;
}

void warn_of_size(const SurfaceMesh& mesh, double scale, const Field* field, const char* command) {
  const double cut_length = field ? field->cut().length : Parameters{}.cut.length;
  const std::string doubt = doubt_of_size(extent_of(mesh), scale, cut_length);
  if (!doubt.empty()) std::fprintf(stderr, "%s: warning: --scale: %s\n", command, doubt.c_str());
}

void tell_note(const SurfaceMesh& mesh, const std::string& file, const char* command) {
  if (!mesh.note.empty()) std::fprintf(stderr, "%s: %s: %s\n", command, file.c_str(), mesh.note.c_str());
}

}  // namespace cleft
