#include "explorer/body/surface_index.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "tests/bodies/subjects.h"
#include "tests/incision/meshes.h"

namespace cleft {

namespace {

/// The nearest place of a triangle: within it, or on one of its edges.
Vec3 nearest_of_triangle(const Vec3& x, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 normal = cross(b - a, c - a);
  const Vec3 foot = x - dot(x - a, normal) / squared_norm(normal) * normal;
  bool within = true;
  Vec3 best = a;
  for (const auto& [p, q] : {std::pair{a, b}, {b, c}, {c, a}}) {
    within = within && dot(cross(q - p, foot - p), normal) >= 0;
    const double part = std::clamp(dot(x - p, q - p) / squared_norm(q - p), 0., 1.);
    if (const Vec3 at = p + part * (q - p); norm(at - x) < norm(best - x)) best = at;
  }
  return within ? foot : best;
}

struct Surface {
  SurfaceMesh mesh;
  std::vector<Vec3> places;

  Surface() : mesh(testing::sheet(testing::lamella(6, 1.5), 10, 15, 1, 0.3)) {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> in(-12, 12);
    for (int i = 0; i < 300; ++i) places.push_back({in(random), in(random), 0.3 * in(random)});
  }
  Vec3 corner(int t, int i) const { return mesh.points[mesh.triangles[t][i]]; }
  Vec3 normal(int t) const { return cross(corner(t, 1) - corner(t, 0), corner(t, 2) - corner(t, 0)); }
  double distance(const Vec3& x, int t) const {
    return norm(nearest_of_triangle(x, corner(t, 0), corner(t, 1), corner(t, 2)) - x);
  }
};

}  // namespace

TEST(SurfaceIndex, FindsTheNearestPlaceOfAllTriangles) {
  const Surface s;
  const SurfaceIndex index(s.mesh);
  for (const Vec3& x : s.places) {
    double nearest = std::numeric_limits<double>::infinity();
    for (int t = 0; t < static_cast<int>(s.mesh.triangles.size()); ++t)
      nearest = std::min(nearest, s.distance(x, t));
    const SurfacePlace found = index.nearest(x);
    ASSERT_NEAR(norm(found.position - x), nearest, 1e-12);
    Vec3 of_weights;
    for (int i = 0; i < 3; ++i) {
      ASSERT_GE(found.weights[i], -1e-12);
      of_weights += found.weights[i] * s.corner(found.triangle, i);
    }
    ASSERT_LT(norm(of_weights - found.position), 1e-11);
  }
}

/// Long triangles across each other, whose boxes all hold the places: as many as are looked at in any one
/// round, and far more. (Sorting all boxes that were found again and again took minutes.)
TEST(SurfaceIndex, FindsTheNearestAmongManyWhoseBoxesOverlap) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> in(-1, 1);
  const auto place = [&] { return Vec3{in(random), in(random), in(random)}; };
  for (const int count : {3, 16, 17, 200, 12000}) {
    Surface s;
    s.mesh = {};
    for (int t = 0; t < count; ++t) {
      const Vec3 middle = place(), way = 30. * place(), aside = 0.05 * place();
      s.mesh.points.insert(s.mesh.points.end(), {middle - way, middle + way, middle + aside});
      s.mesh.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
    }
    const SurfaceIndex index(s.mesh);
    for (int i = 0; i < 600; ++i) {
      const Vec3 x = place();
      const SurfacePlace found = index.nearest(x);
      ASSERT_GE(found.triangle, 0);
      if (i >= 50) continue;
      double nearest = std::numeric_limits<double>::infinity();
      for (int t = 0; t < count; ++t) nearest = std::min(nearest, s.distance(x, t));
      ASSERT_NEAR(norm(found.position - x), nearest, 1e-9) << count;
    }
  }
}

/// Of the two sides of a fold only that which faces alike, within reach.
TEST(SurfaceIndex, KeepsToTrianglesThatFaceAlikeAndAreNear) {
  const Surface s;
  const SurfaceIndex index(s.mesh);
  const Vec3 up{0.1, 0.2, 1};
  int none = 0;
  for (const Vec3& x : s.places)
    for (const double reach : {1., 3.}) {
      double nearest = std::numeric_limits<double>::infinity();
      for (int t = 0; t < static_cast<int>(s.mesh.triangles.size()); ++t)
        if (dot(s.normal(t), up) > 0) nearest = std::min(nearest, s.distance(x, t));
      const SurfacePlace found = index.nearest(x, up, reach);
      ASSERT_EQ(found.triangle >= 0, nearest <= reach);
      none += found.triangle < 0;
      if (found.triangle < 0) continue;
      ASSERT_NEAR(norm(found.position - x), nearest, 1e-12);
      ASSERT_GT(dot(s.normal(found.triangle), up), 0);
    }
  EXPECT_GT(none, 50);
}

TEST(SurfaceIndex, MeetsTheFirstTriangleOnTheWay) {
  const Surface s;
  const SurfaceIndex index(s.mesh);
  int met = 0;
  for (const Vec3& from : s.places) {
    const Vec3 way{0.3, -0.2, -2.5};
    double first = 2;
    for (int t = 0; t < static_cast<int>(s.mesh.triangles.size()); ++t) {
      const Vec3 a = s.corner(t, 0), b = s.corner(t, 1), c = s.corner(t, 2), n = s.normal(t);
      const double part = dot(a - from, n) / dot(way, n);
      const Vec3 at = from + part * way;
      if (part >= 0 && part <= 1 && dot(cross(b - a, at - a), n) >= 0 && dot(cross(c - b, at - b), n) >= 0 &&
          dot(cross(a - c, at - c), n) >= 0)
        first = std::min(first, part);
    }
    const auto found = index.meets(from, way);
    ASSERT_EQ(found.has_value(), first <= 1);
    if (!found) continue;
    ASSERT_NEAR(*found, first, 1e-10);
    ++met;
  }
  EXPECT_GT(met, 30);
}

}  // namespace cleft
