#include "tests/incision/stress/surface_walker.h"

#include <cmath>

namespace cleft::stress {

namespace {
constexpr double sharpest_fold = 0.2;  // cosine: over sharper ones no blade stands upright on both sides
}

Ground::Ground(const SurfaceMesh& surface) : mesh(surface), vertex_normals(surface.points.size()) {
  for (const auto& t : surface.triangles) {
    const Vec3 n =
        cross(surface.points[t[1]] - surface.points[t[0]], surface.points[t[2]] - surface.points[t[0]]);
    for (const int v : t) vertex_normals[v] += n;
  }
  for (Vec3& n : vertex_normals)
    if (squared_norm(n) > 0) n = normalized(n);
}

Vec3 Ground::face_normal(int t) const {
  const auto& v = mesh.triangle(t).vertex;
  return normalized(
      cross(mesh.position(v[1]) - mesh.position(v[0]), mesh.position(v[2]) - mesh.position(v[0])));
}

Vec3 Ground::normal(int t, const Vec3& place) const {
  const auto& v = mesh.triangle(t).vertex;
  const Vec3 face = face_normal(t);
  Vec3 n;
  for (int i = 0; i < 3; ++i)
    n += std::max(0., dot(face, cross(mesh.position(v[(i + 1) % 3]) - place,
                                      mesh.position(v[(i + 2) % 3]) - place))) *
         vertex_normals[v[i]];
  // On folds a vertex's normal may point along a face: the blade must not.
  n = squared_norm(n) > 0 ? normalized(n) : face;
  return dot(n, face) > 0.3 ? n : normalized(n + (0.5 - dot(n, face)) * face);
}

double Ground::edge_length(int t) const {
  const auto& v = mesh.triangle(t).vertex;
  double sum = 0;
  for (int i = 0; i < 3; ++i) sum += norm(mesh.position(v[(i + 1) % 3]) - mesh.position(v[i]));
  return sum / 3;
}

SurfaceWalker::SurfaceWalker(const Ground& ground, int triangle, const Vec3& place, const Vec3& heading)
    : ground_(ground), triangle_(triangle), place_(place) {
  const Vec3 n = ground.face_normal(triangle);
  heading_ = normalized(heading - dot(heading, n) * n);
}

void SurfaceWalker::turn(double angle) {
  const Vec3 left = cross(ground_.face_normal(triangle_), heading_);
  heading_ = normalized(std::cos(angle) * heading_ + std::sin(angle) * left);
}

bool SurfaceWalker::go(double length) {
  int entered = -1;
  for (int guard = 0; guard < 10000; ++guard) {
    const CutMesh::Triangle& t = ground_.mesh.triangle(triangle_);
    const Vec3 n = ground_.face_normal(triangle_);
    int edge = -1;
    double least = length;
    for (int i = 0; i < 3; ++i) {
      const Vec3 a = ground_.mesh.position(t.vertex[i]), b = ground_.mesh.position(t.vertex[(i + 1) % 3]);
      const Vec3 inward = cross(n, b - a);
      const double rate = dot(heading_, inward);
      if (i == entered || !(rate < 0)) continue;
      const double way = std::max(0., dot(place_ - a, inward) / -rate);
      if (way < least) least = way, edge = i;
    }
    place_ += least * heading_;
    if (edge < 0) return true;
    length -= least;
    const int next = t.neighbor[edge];
    at_boundary_ = next < 0;
    if (at_boundary_ || dot(n, ground_.face_normal(next)) < sharpest_fold) return false;
    const Vec3 axis =
        normalized(ground_.mesh.position(t.vertex[(edge + 1) % 3]) - ground_.mesh.position(t.vertex[edge]));
    const double along = dot(heading_, axis), out = dot(heading_, cross(axis, n));
    heading_ = normalized(along * axis + out * cross(axis, ground_.face_normal(next)));
    entered = ground_.mesh.triangle(next).corner(t.vertex[(edge + 1) % 3]);
    triangle_ = next;
  }
  return false;
}

}  // namespace cleft::stress
