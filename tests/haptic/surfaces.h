// Surfaces for the haptic tests, and answers of brute force.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <span>
#include <vector>

#include "haptic/contact_query.h"

namespace cleft::testing {

struct Surface {
  std::vector<Vec3> points;
  std::vector<std::array<int, 3>> triangles;
};

/// n x n squares of edge h about the origin, each cut along one diagonal; seen from above.
template <class Height>
Surface sheet(int n, double h, const Height& height) {
  Surface s;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      const double x = (i - n / 2.) * h, y = (j - n / 2.) * h;
      s.points.push_back({x, y, height(x, y)});
    }
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int a = j * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1;
      s.triangles.push_back({a, b, d});
      s.triangles.push_back({a, d, c});
    }
  return s;
}

inline Surface flat(int n, double h) {
  return sheet(n, h, [](double, double) { return 0.; });
}

/// A closed ball with bumps: rings x 2 rings x 2 triangles about the z axis.
inline Surface ball(int rings, double radius, double bumps = 0) {
  Surface s;
  const int around = 2 * rings;
  const auto place = [&](double a, double b) {
    const double r = radius * (1 + bumps * std::sin(5 * a) * std::cos(4 * b));
    return Vec3{r * std::sin(a) * std::cos(b), r * std::sin(a) * std::sin(b), r * std::cos(a)};
  };
  s.points = {place(0, 0), place(std::numbers::pi, 0)};
  const auto at = [&](int ring, int k) { return 2 + (ring - 1) * around + (k + around) % around; };
  for (int ring = 1; ring < rings; ++ring)
    for (int k = 0; k < around; ++k)
      s.points.push_back(place(std::numbers::pi * ring / rings, 2 * std::numbers::pi * k / around));
  for (int k = 0; k < around; ++k) {
    s.triangles.push_back({0, at(1, k), at(1, k + 1)});
    s.triangles.push_back({1, at(rings - 1, k + 1), at(rings - 1, k)});
    for (int ring = 1; ring + 1 < rings; ++ring) {
      s.triangles.push_back({at(ring, k), at(ring + 1, k), at(ring + 1, k + 1)});
      s.triangles.push_back({at(ring, k), at(ring + 1, k + 1), at(ring, k + 1)});
    }
  }
  return s;
}

inline Corners corners(const Surface& s, std::size_t t) {
  return {s.points[s.triangles[t][0]], s.points[s.triangles[t][1]], s.points[s.triangles[t][2]]};
}

/// The first triangle met by solving from + x d = a + y (b - a) + z (c - a) for each: another formula than
/// the grid's own. Fraction 2 where there is none; `margin` is how near the decision was.
struct BruteHit {
  double fraction = 2, margin = 1;
};
inline BruteHit brute_first_contact(const Surface& s, const Vec3& from, const Vec3& to, Facing facing) {
  BruteHit best;
  const Vec3 d = to - from;
  for (std::size_t t = 0; t < s.triangles.size(); ++t) {
    const Corners c = corners(s, t);
    const Vec3 e1 = c[1] - c[0], e2 = c[2] - c[0], p = cross(d, e2);
    const double det = dot(e1, p);
    if (det == 0 || (facing == Facing::front && det < 0) || (facing == Facing::back && det > 0)) continue;
    const Vec3 o = from - c[0], q = cross(o, e1);
    const double y = dot(o, p) / det, z = dot(d, q) / det, x = dot(e2, q) / det;
    const double inside = std::min({y, z, 1 - y - z, x, 1 - x});
    if (inside > -1e-7) best.margin = std::min(best.margin, std::abs(inside));
    if (inside >= 0) best.fraction = std::min(best.fraction, x);
  }
  return best;
}

/// The least distance to any triangle, by another way: projection, else the best of the three edges.
inline double brute_distance(const Surface& s, const Vec3& x) {
  double least = 1e300;
  for (std::size_t t = 0; t < s.triangles.size(); ++t) {
    const Corners c = corners(s, t);
    const Vec3 n = normalized(scaled_normal(c));
    const double height = dot(x - c[0], n);
    const Vec3 foot = x - height * n;
    bool inside = true;
    double edges = 1e300;
    for (int i = 0; i < 3; ++i) {
      const Vec3 &a = c[i], &b = c[(i + 1) % 3];
      inside = inside && dot(cross(b - a, foot - a), n) >= 0;
      const double part = std::clamp(dot(x - a, b - a) / squared_norm(b - a), 0., 1.);
      edges = std::min(edges, norm(x - lerp(a, b, part)));
    }
    least = std::min(least, inside ? std::abs(height) : edges);
  }
  return least;
}

}  // namespace cleft::testing
