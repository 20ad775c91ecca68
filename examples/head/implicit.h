// Implicit primitives and their blends. A value is negative inside, about the distance (mm) near the surface.
#pragma once

#include <algorithm>
#include <cmath>

#include "base/vec3.h"

namespace cleft::head {

/// Ellipsoid of half-axes r: exact on the surface, with the gradient's length near 1 around it.
inline double ellipsoid(const Vec3& p, const Vec3& center, const Vec3& r) {
  const Vec3 q = p - center;
  const double a = norm({q.x / r.x, q.y / r.y, q.z / r.z});
  const double b = norm({q.x / (r.x * r.x), q.y / (r.y * r.y), q.z / (r.z * r.z)});
  return b == 0 ? -std::min({r.x, r.y, r.z}) : a * (a - 1) / b;
}

/// Capsule from a to b whose radius runs linearly from ra to rb.
inline double capsule(const Vec3& p, const Vec3& a, const Vec3& b, double ra, double rb) {
  const double s = std::clamp(dot(p - a, b - a) / squared_norm(b - a), 0., 1.);
  return norm(p - lerp(a, b, s)) - (ra + s * (rb - ra));
}

/// Union whose crease is rounded over about k mm (Quilez's polynomial smooth minimum).
inline double join(double a, double b, double k) {
  const double h = std::max(k - std::abs(a - b), 0.) / k;
  return std::min(a, b) - h * h * k / 4;
}

/// A groove's profile at the distance x (mm) from its middle line: 1 there, fading out over about `width` mm.
inline double groove(double x, double width) { return std::exp(-x * x / (width * width)); }

/// a without b, rounded over about k mm.
inline double carve(double a, double b, double k) { return -join(-a, b, k); }

}  // namespace cleft::head
