#include "explorer/incision/triangle_quality.h"

#include <algorithm>
#include <cmath>

namespace cleft {

namespace {

constexpr double flat = 1e-9;  ///< height over edge length: the same plane, but for rounding

struct Quad {
  int a, b, c, d;  // triangles (a, b, c) and (b, a, d)
};

Quad quad_at(const CutMesh& mesh, int t, int i) {
  const CutMesh::Triangle &x = mesh.triangle(t), &y = mesh.triangle(x.neighbor[i]);
  const int b = x.vertex[(i + 1) % 3];
  return {x.vertex[i], b, x.vertex[(i + 2) % 3], y.vertex[(y.corner(b) + 2) % 3]};
}

/// The smaller radius ratio of the two triangles after flipping edge i of t; 0 where it must not be flipped.
double ratio_after_flip(const CutMesh& mesh, int t, int i, double bend) {
  const int other = mesh.triangle(t).neighbor[i];
  if (!mesh.is_skin(other)) return 0;
  const Quad q = quad_at(mesh, t, i);
  const Vec3 &a = mesh.position(q.a), &b = mesh.position(q.b), &c = mesh.position(q.c),
             &d = mesh.position(q.d);
  const Vec3 n = cross(d - c, b - a);  // of the quadrilateral, by its diagonals
  const double size = norm(n);
  const double plane = std::max(bend, flat * std::max(norm(b - a), norm(d - c)));
  if (size == 0 || std::abs(dot(n, a - c)) > plane * size) return 0;  // between the diagonals
  if (dot(cross(d - a, c - a), n) <= 0 || dot(cross(b - d, c - d), n) <= 0) return 0;  // not convex
  if (mesh.any_triangle_with(q.c, q.d) >= 0 || mesh.any_triangle_with(q.d, q.c) >= 0) return 0;
  return std::min(radius_ratio(a, d, c), radius_ratio(d, b, c));
}

/// `bent` becomes true where the surface was not flat there.
bool flip_best(CutMesh& mesh, int t, double bend, bool& bent) {
  int best = -1;
  double most = 0;
  for (int i = 0; i < 3; ++i) {
    const double after = ratio_after_flip(mesh, t, i, bend);
    if (after <= 0) continue;
    const double before = std::min(radius_ratio(mesh, t), radius_ratio(mesh, mesh.triangle(t).neighbor[i]));
    if (after > 1.2 * before && after > most) most = after, best = i;
  }
  if (best < 0) return false;
  if (bend > 0 && ratio_after_flip(mesh, t, best, 0) <= 0) bent = true;
  mesh.flip_edge(t, best);
  return true;
}

/// The longest edge of t that is no lip: a new vertex at the foot of its height, or in its middle.
bool split_longest(CutMesh& mesh, int t) {
  const CutMesh::Triangle x = mesh.triangle(t);
  int longest = -1;
  double most = 0;
  for (int i = 0; i < 3; ++i) {
    const double length = norm(mesh.position(x.vertex[(i + 1) % 3]) - mesh.position(x.vertex[i]));
    if (length > most) most = length, longest = i;
  }
  const int across = longest < 0 ? CutMesh::non_manifold : x.neighbor[longest];
  if (across == CutMesh::non_manifold) return false;
  const Vec3 &a = mesh.position(x.vertex[longest]), &b = mesh.position(x.vertex[(longest + 1) % 3]),
             &c = mesh.position(x.vertex[(longest + 2) % 3]);
  double part = dot(c - a, b - a) / squared_norm(b - a);
  if (part < 0.2 || part > 0.8) part = 0.5;
  const Vec3 place = lerp(a, b, part);
  double before = radius_ratio(a, b, c),
         after = std::min(radius_ratio(a, place, c), radius_ratio(place, b, c));
  if (across >= 0 && mesh.is_skin(across)) {
    const Vec3& d = mesh.position(quad_at(mesh, t, longest).d);
    before = std::min(before, radius_ratio(b, a, d));
    after = std::min({after, radius_ratio(b, place, d), radius_ratio(place, a, d)});
  }
  if (after < 1.2 * before) return false;
  mesh.split_edge(t, longest, place);
  return true;
}

}  // namespace

double radius_ratio(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double x = norm(b - a), y = norm(c - b), z = norm(a - c);
  const double product = (x + y + z) * x * y * z;
  return product > 0 ? 4 * squared_norm(cross(b - a, c - a)) / product : 0;
}

double radius_ratio(const CutMesh& mesh, int t) {
  const auto& v = mesh.triangle(t).vertex;
  return radius_ratio(mesh.position(v[0]), mesh.position(v[1]), mesh.position(v[2]));
}

double smallest_radius_ratio(const CutMesh& mesh) {
  double least = 1;
  for (std::size_t t = 0; t < mesh.triangles().size(); ++t)
    if (mesh.triangles()[t].region == Region::skin)
      least = std::min(least, radius_ratio(mesh, static_cast<int>(t)));
  return least;
}

double smallest_given_radius_ratio(const CutMesh& mesh) {
  const auto given = [&](int v) {
    const CutMesh::Vertex& x = mesh.vertex(v);
    return x.parents[0] < 0 && x.cut < 0 && x.original == x.position;
  };
  double least = 1;
  for (std::size_t t = 0; t < mesh.triangles().size(); ++t) {
    const auto& v = mesh.triangles()[t].vertex;
    if (given(v[0]) && given(v[1]) && given(v[2]))
      least = std::min(least, radius_ratio(mesh, static_cast<int>(t)));
  }
  return least;
}

bool mend_slivers(CutMesh& mesh, const std::vector<int>& triangles, double target, double bend) {
  std::vector<int> work = triangles;
  bool bent = false;
  for (std::size_t changes = 0, most = 3 * triangles.size() + 12; !work.empty() && changes < most;) {
    const int t = work.back();
    work.pop_back();
    if (!mesh.is_skin(t) || radius_ratio(mesh, t) >= target) continue;
    const std::size_t first_new = mesh.triangles().size();
    const auto neighbors = mesh.triangle(t).neighbor;
    if (!flip_best(mesh, t, bend, bent) && !split_longest(mesh, t)) continue;
    ++changes;
    work.insert(work.begin(), neighbors.begin(), neighbors.end());
    work.insert(work.begin(), t);
    for (std::size_t n = first_new; n < mesh.triangles().size(); ++n)
      work.insert(work.begin(), static_cast<int>(n));
  }
  return bent;
}

}  // namespace cleft
