// A segment, a point and a box against one triangle.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "base/vec3.h"

namespace cleft {

using Corners = std::array<Vec3, 3>;

inline Vec3 scaled_normal(const Corners& c) { return cross(c[1] - c[0], c[2] - c[0]); }

/// Whether the segment from one point to another passes through the triangle, and where.
struct Passage {
  bool passes = false, inward = false;  ///< against the normal
  double fraction = 0;                  ///< of the segment
  Vec3 normal;                          ///< of the triangle, not scaled
};

/// Most triangles near a short segment have both of its ends on one side, which is tested first. An edge
/// belongs exactly to both triangles that share it, and an end to one of the two segments that meet in it: no
/// contact is missed.
inline Passage pass_through(const Vec3& from, const Vec3& to, const Corners& c) {
  const Vec3 normal = scaled_normal(c);
  const double before = dot(normal, from - c[0]), after = dot(normal, to - c[0]);
  if ((before > 0) == (after > 0)) return {};
  const Vec3 a = c[0] - from, b = c[1] - from, d = c[2] - from, along = to - from;
  // Volumes of the same edge differ in sign alone, whoever computes them.
  const double x = dot(cross(a, b), along), y = dot(cross(b, d), along), z = dot(cross(d, a), along);
  if (!((x >= 0 && y >= 0 && z >= 0) || (x <= 0 && y <= 0 && z <= 0))) return {};
  return {true, before > 0, before / (before - after), normal};
}

struct ClosestPoint {
  Vec3 position;
  enum Feature { face, edge, vertex } feature = face;
  int corner = 0;  ///< of a vertex: which
};

/// A lower bound of the squared distance from p to the triangle: that to its box.
inline double least_squared_distance(const Vec3& p, const Corners& c) {
  const auto beside = [](double x, double a, double b, double d) {
    return std::max({0., std::min({a, b, d}) - x, x - std::max({a, b, d})});
  };
  return squared_norm({beside(p.x, c[0].x, c[1].x, c[2].x), beside(p.y, c[0].y, c[1].y, c[2].y),
                       beside(p.z, c[0].z, c[1].z, c[2].z)});
}

/// The triangle's point nearest to p (Ericson, Real-Time Collision Detection, 5.1.5).
inline ClosestPoint closest_point(const Vec3& p, const Corners& c) {
  const auto& [A, B, C] = c;
  const Vec3 ab = B - A, ac = C - A, ap = p - A, bp = p - B, cp = p - C;
  const double d1 = dot(ab, ap), d2 = dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return {A, ClosestPoint::vertex, 0};
  const double d3 = dot(ab, bp), d4 = dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return {B, ClosestPoint::vertex, 1};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return {A + d1 / (d1 - d3) * ab, ClosestPoint::edge};
  const double d5 = dot(ab, cp), d6 = dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return {C, ClosestPoint::vertex, 2};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return {A + d2 / (d2 - d6) * ac, ClosestPoint::edge};
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 >= d3 && d5 >= d6)
    return {B + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (C - B), ClosestPoint::edge};
  const double whole = 1 / (va + vb + vc);
  return {A + vb * whole * ab + vc * whole * ac, ClosestPoint::face};
}

/// Whether the triangle's plane meets the box around `middle`. Together with the test of the triangle's own
/// box this is sufficient: testing the axes of the edges would cost a cut more than the few extra boxes cost
/// a query.
inline bool plane_meets_box(const Corners& c, const Vec3& normal, const Vec3& middle, double half) {
  const Vec3 to = c[0] - middle;
  return std::abs(dot(normal, to)) <= half * (std::abs(normal.x) + std::abs(normal.y) + std::abs(normal.z));
}

}  // namespace cleft
