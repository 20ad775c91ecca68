#include "haptic/contact_query.h"
#include "haptic/voxel_visit.h"

namespace cleft {

namespace {

constexpr double cos_crease = 0.766;  // 40 degrees: beyond, an edge of the surface is meant to be sharp
constexpr double outside = 1e-9;      // of barycentric coordinates

/// x of A x = b with the columns a0, a1, a2 of A; false where A is singular.
bool solve(const Vec3& a0, const Vec3& a1, const Vec3& a2, const Vec3& b, Vec3& x) {
  const Vec3 m = cross(a1, a2);
  const double det = dot(a0, m);
  if (!(std::abs(det) > 1e-12 * norm(a0) * norm(m))) return false;
  x = 1 / det * Vec3{dot(b, m), dot(a0, cross(b, a2)), dot(a0, cross(a1, b))};
  return true;
}

}  // namespace

bool ContactReader::project(int triangle, const Vec3& x, const SurfaceProxy& before,
                            SurfaceProxy& out) const {
  Corners c;
  ContactTriangle t;
  if (!corners_of(triangle, c, t) || t.wall != before.wall) return false;
  const Vec3 area = scaled_normal(c);
  const double size = norm(area);
  if (!(size > 0) || dot(area, before.normal) <= 0.2 * size) return false;
  const Vec3 face = 1 / size * area;
  Vec3 n[3];
  for (int i = 0; i < 3; ++i) {
    n[i] = surface_.normals_[t.vertex[i]].at(version_);
    if (dot(n[i], face) < cos_crease) n[i] = face;
  }
  const Vec3 e1 = c[1] - c[0], e2 = c[2] - c[0], m1 = n[1] - n[0], m2 = n[2] - n[0];
  // Newton for p(u, v) - d n(u, v) = x, from the projection along the triangle's own normal.
  double d = dot(c[0] - x, face), u = 0, v = 0;
  Vec3 normal;
  for (int round = 0; round < 8; ++round) {
    normal = n[0] + u * m1 + v * m2;
    const Vec3 miss = x - (c[0] + u * e1 + v * e2 - d * normal);
    Vec3 step;
    if (round > 0 && squared_norm(miss) < 1e-24 * size) break;
    if (round == 7 || !solve(e1 - d * m1, e2 - d * m2, -normal, miss, step)) return false;
    u += step.x, v += step.y, d += step.z;
    if (std::abs(u) > 8 || std::abs(v) > 8) return false;
  }
  if (u < -outside || v < -outside || u + v > 1 + outside) return false;
  const double length = norm(normal);
  out = {triangle, d * length, c[0] + u * e1 + v * e2, 1 / length * normal, t.wall};
  return true;
}

SurfaceProxy ContactReader::proxy(const Vec3& x, const SurfaceProxy& before) const {
  SurfaceProxy found;
  if (before && project(before.triangle, x, before, found)) return found;
  const Vec3 moved = x - (before.position - before.depth * before.normal);
  const Vec3 guess = before.position + moved - dot(moved, before.normal) * before.normal;
  const double radius = 2 * norm(moved) + cells_.cell() / 2;
  double least = radius, least_clamped = radius;
  SurfaceProxy clamped;  // if no normal points to x: next to a boundary or a sharp edge
  visit_voxels(guess, radius, [&](const CellList& list) {
    const int count = list.count();
    for (int k = 0; k < count; ++k) {
      const int id = list[k];
      Corners c;
      ContactTriangle t;
      if (id < 0 || !corners_of(id, c, t) || t.wall != before.wall) continue;
      const Vec3 nearest = closest_point(guess, c).position;
      const double away = norm(nearest - guess);
      if (away >= least && found) continue;
      if (away < least_clamped) {
        const Vec3 n = normalized(scaled_normal(c));
        if (dot(n, before.normal) > 0.2) {
          least_clamped = away;
          clamped = {id, dot(nearest - x, n), nearest, n, t.wall};
        }
      }
      SurfaceProxy candidate;
      if (!project(id, x, before, candidate)) continue;
      const double distance = norm(candidate.position - guess);
      if (distance < least) least = distance, found = candidate;
    }
    return found ? least : radius;
  });
  return found ? found : clamped;
}

}  // namespace cleft
