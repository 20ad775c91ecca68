// The shape of triangles.
#pragma once

#include "explorer/incision/cut_mesh.h"

namespace cleft {

/// Twice the inscribed over the circumscribed radius: 1 equilateral, 0 degenerate.
inline double radius_ratio(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double x = norm(b - a), y = norm(c - b), z = norm(a - c);
  const double product = (x + y + z) * x * y * z;
  return product > 0 ? 4 * squared_norm(cross(b - a, c - a)) / product : 0;
}
inline double radius_ratio(const CutMesh& mesh, int t) {
  const auto& v = mesh.triangle(t).vertex;
  return radius_ratio(mesh.position(v[0]), mesh.position(v[1]), mesh.position(v[2]));
}

/// The smallest of all triangles of the skin.
double smallest_radius_ratio(const CutMesh& mesh);
/// Of those that are still as the mesh was given; 1 where none is.
double smallest_given_radius_ratio(const CutMesh& mesh);

}  // namespace cleft
