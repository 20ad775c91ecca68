#include "explorer/incision/triangle_quality.h"

#include <gtest/gtest.h>

#include <numbers>

#include "explorer/incision/mend_slivers.h"
#include "tests/incision/meshes.h"

namespace cleft {
namespace {

Vec3 normal(const CutMesh& mesh, int t) {
  const auto& v = mesh.triangle(t).vertex;
  return normalized(
      cross(mesh.position(v[1]) - mesh.position(v[0]), mesh.position(v[2]) - mesh.position(v[0])));
}

TEST(TriangleQuality, NeedlesAreMendedByTheirNeighboursEdges) {
  // The strip between two lips at 0.2 rad, cut off where it is 0.0006 wide. Splits of the needle's own edges
  // do not mend it.
  CutMesh mesh({{{0, 0, 0}, {0.27, 0, 0}, {0, 0.0006, 0}, {3.3 * std::cos(0.2), 3.3 * std::sin(0.2), 0}},
                {{0, 1, 2}, {2, 1, 3}}});
  constexpr double asked = 0.005;
  ASSERT_LT(radius_ratio(mesh, 0), asked);
  EXPECT_FALSE(mend_needles(mesh, {0, 1}, 1.2 * asked));
  EXPECT_GT(smallest_radius_ratio(mesh), asked);
  EXPECT_TRUE(testing::adjacency_holds(mesh));
}

TEST(TriangleQuality, NoFlipTurnsAFaceAwayFromThoseThatWereThere) {
  // A narrow triangle (a, b, c) on a fold of 70 degrees along a b: flipped, (a, d, c) would stand across the
  // fold.
  constexpr double fold = 70 * std::numbers::pi / 180, bend = 0.02;
  CutMesh mesh(
      {{{0, 0, 0}, {1, 0, 0}, {-0.005, 0.02, 0}, {0.5, -0.5 * std::cos(fold), -0.5 * std::sin(fold)}},
       {{0, 1, 2}, {1, 0, 3}}});
  const Vec3 one = normal(mesh, 0), other = normal(mesh, 1);
  ASSERT_NEAR(dot(one, other), std::cos(fold), 1e-12);
  mend_slivers(mesh, {0, 1}, 0.05, bend);
  for (int t = 0; t < static_cast<int>(mesh.triangles().size()); ++t)
    EXPECT_GT(std::min(dot(normal(mesh, t), one), dot(normal(mesh, t), other)), std::cos(fold) - 0.1) << t;
}

}  // namespace
}  // namespace cleft
