// The place of a triangle that is nearest to a point.
#pragma once

#include <array>

#include "base/vec3.h"

namespace cleft {

/// Its barycentric weights of a, b and c, which sum to 1 (Ericson, Real-Time Collision Detection, 5.1.5).
inline std::array<double, 3> nearest_weights(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const double d1 = dot(ab, ap), d2 = dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return {1, 0, 0};
  const double d3 = dot(ab, bp), d4 = dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return {0, 1, 0};
  const auto between = [](double from, double to) { return from / (from - to); };
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return {1 - between(d1, d3), between(d1, d3), 0};
  const double d5 = dot(ab, cp), d6 = dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return {0, 0, 1};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return {1 - between(d2, d6), 0, between(d2, d6)};
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 >= d3 && d5 >= d6) {
    const double part = between(d4 - d3, d6 - d5);
    return {0, 1 - part, part};
  }
  const double whole = va + vb + vc;
  return {va / whole, vb / whole, vc / whole};
}

}  // namespace cleft
