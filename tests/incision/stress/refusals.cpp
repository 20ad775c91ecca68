#include "tests/incision/stress/refusals.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "base/error.h"

namespace cleft::stress {

namespace {

constexpr double beside = 0.05;  ///< of the mean edge: so near to the path's place a triangle is met by it
constexpr double upright = 0.1;  ///< sine of the angle between blade and triangle, at least
constexpr double rounding = 1e-9;
constexpr double along = 0.1;  ///< sine of the angle between path and lip: below it runs along the lip

double distance_to_edge(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 ab = b - a;
  const double length = squared_norm(ab);
  const double part = length > 0 ? std::clamp(dot(p - a, ab) / length, 0., 1.) : 0;
  return norm(a + part * ab - p);
}

double distance_to_triangle(const CutMesh& mesh, int t, const Vec3& p) {
  const auto& v = mesh.triangle(t).vertex;
  const Vec3 corner[] = {mesh.position(v[0]), mesh.position(v[1]), mesh.position(v[2])};
  const Vec3 n = cross(corner[1] - corner[0], corner[2] - corner[0]);
  bool over = squared_norm(n) > 0;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    const Vec3 &a = corner[i], &b = corner[(i + 1) % 3];
    over = over && dot(cross(b - a, p - a), n) >= 0;
    least = std::min(least, distance_to_edge(p, a, b));
  }
  return over ? std::min(least, std::abs(dot(p - corner[0], n)) / norm(n)) : least;
}

/// How far along N the line pierces a triangle that faces that way.
std::optional<double> height_of_hit(const CutMesh& mesh, int t, const PathFrame& frame) {
  const auto& v = mesh.triangle(t).vertex;
  const Vec3 a = mesh.position(v[0]), ab = mesh.position(v[1]) - a, ac = mesh.position(v[2]) - a;
  const Vec3 n = cross(ab, ac);
  const double facing = dot(n, frame.outward);
  if (!(facing > 0)) return std::nullopt;
  const double height = dot(n, a - frame.position) / facing;
  const Vec3 way = frame.position + height * frame.outward - a;
  const double x = dot(cross(way, ac), n) / squared_norm(n), y = dot(cross(ab, way), n) / squared_norm(n);
  if (std::min({x, y, 1 - x - y}) < rounding) return std::nullopt;
  return height;
}

bool runs_along_wound(const CutMesh& cut, const Vec3& place, const PathFrame& frame, double near) {
  for (const CutMesh::Triangle& t : cut.triangles())
    for (int i = 0; i < 3 && t.region == Region::skin; ++i) {
      if (!cut.is_wall(t.neighbor[i])) continue;
      const Vec3 &a = cut.position(t.vertex[i]), &b = cut.position(t.vertex[(i + 1) % 3]);
      if (distance_to_edge(place, a, b) < near && norm(cross(normalized(b - a), frame.along)) < along)
        return true;
    }
  return false;
}

/// Whether triangles of the input around vertex v are not one fan.
bool torn(const CutMesh& mesh, int v) {
  try {
    mesh.skin_fan(v);
    return false;
  } catch (const InputError&) {
    return true;
  }
}

}  // namespace

std::string reason_to_refuse(const Ground& ground, const ScalpelPath& path, const Vec3& place, double s,
                             const CutMesh& cut) {
  const PathFrame frame = path.at(s);
  double shortest_edge = std::numeric_limits<double>::infinity();
  for (int t = 0; t < static_cast<int>(ground.mesh.triangles().size()); ++t) {
    const double edge = ground.edge_length(t), distance = distance_to_triangle(ground.mesh, t, place);
    if (distance > edge) continue;
    const CutMesh::Triangle& triangle = ground.mesh.triangle(t);
    for (int i = 0; i < 3; ++i)
      if (triangle.neighbor[i] == CutMesh::non_manifold || torn(ground.mesh, triangle.vertex[i]))
        return "the mesh is no manifold";
    if (distance > beside * edge) continue;
    shortest_edge = std::min(shortest_edge, edge);
    if (dot(ground.face_normal(t), frame.outward) < upright) return lies_along;
  }
  return runs_along_wound(cut, place, frame, beside * shortest_edge) ? "along a wound" : "";
}

std::string reason_never_to_begin(const Ground& ground, const ScalpelPath& path, const CutMesh& cut) {
  const PathFrame frame = path.at(0);
  double least = std::numeric_limits<double>::infinity();
  for (int t = 0; t < static_cast<int>(ground.mesh.triangles().size()); ++t)
    if (const auto height = height_of_hit(ground.mesh, t, frame);
        height && std::abs(*height) < std::abs(least))
      least = *height;
  if (std::abs(least) > path.length() / 2) return "no surface where it begins";
  return reason_to_refuse(ground, path, frame.position + least * frame.outward, 0, cut);
}

}  // namespace cleft::stress
