#include <gtest/gtest.h>

#include "base/error.h"
#include "tests/incision/meshes.h"

namespace cleft {
namespace {

using testing::path_through;
using testing::up;

constexpr double pi = std::numbers::pi;

ScalpelPath arc(double radius, double angle, int points) {
  std::vector<Vec3> places;
  for (int i = 0; i < points; ++i) {
    const double a = angle * i / (points - 1);
    places.push_back({radius * std::cos(a), radius * std::sin(a), 0});
  }
  return path_through(places, up, 1);
}

TEST(ScalpelPath, StraightLineIsExact) {
  const ScalpelPath path = path_through({{-5, 0, 0}, {5, 0, 0}}, up, 1);
  EXPECT_DOUBLE_EQ(path.length(), 10);
  for (const double s : {-3.0, 0.0, 0.7, 9.9, 14.0}) {
    const PathFrame f = path.at(s);
    EXPECT_NEAR(f.position.x, s - 5, 1e-14);
    EXPECT_EQ(f.across, (Vec3{0, 1, 0}));
    const PathCoordinates c = path.coordinates({s - 5, 2.5, -0.5});
    EXPECT_NEAR(c.s, s, 1e-14);
    EXPECT_EQ(c.v, 2.5);  // v > 0 lies where N x T points
    EXPECT_EQ(c.w, -0.5);
  }
}

TEST(ScalpelPath, ArcIsParametrisedByItsLength) {
  // A natural spline bends too little near its ends: its error there is O(h^2), h the points' distance over
  // radius.
  const double radius = 10, angle = pi / 2, h = angle / 64;
  const ScalpelPath path = arc(radius, angle, 65);
  EXPECT_NEAR(path.length(), radius * angle, radius * h * h);
  for (double s = 0; s < path.length(); s += 0.37) {
    EXPECT_NEAR(norm(path.at(s).position), radius, radius * h * h);
    const double step = 1e-4;  // of a central difference: rounding / step, curvature step^2
    EXPECT_NEAR(norm(path.at(s + step).position - path.at(s - step).position) / (2 * step), 1, 1e-6);
  }
}

TEST(ScalpelPath, CoordinatesAgreeWithBruteForce) {
  const ScalpelPath path = path_through({{0, 0, 0}, {4, 3, 1}, {9, 1, 0}, {12, 4, 2}}, up, 1);
  for (const Vec3& x : {Vec3{3, 4, 1}, Vec3{6, 0, 0.5}, Vec3{9, 3, 1}, Vec3{2, -1, 0}}) {
    double nearest = 0, least = 1e9;  // N is constant here: distance across N alone
    const int samples = 200000;
    for (int i = 0; i <= samples; ++i) {
      const Vec3 d = x - path.at(path.length() * i / samples).position;
      if (std::hypot(d.x, d.y) < least) least = std::hypot(d.x, d.y), nearest = path.length() * i / samples;
    }
    const PathCoordinates c = path.coordinates(x);
    EXPECT_NEAR(c.s, nearest, path.length() / samples);
    EXPECT_NEAR(std::abs(c.v), least, 1e-8);
    const PathFrame f = path.at(c.s);
    EXPECT_LT(norm(f.position + c.v * f.across + c.w * f.outward - x), 1e-11);
  }
}

TEST(ScalpelPath, MergesStepsOfNoLength) {
  const ScalpelPath path = path_through({{0, 0, 0}, {0, 0, 0}, {1, 0, 0}, {3, 0, 0}, {3, 0, 0}}, up, 1);
  EXPECT_DOUBLE_EQ(path.length(), 3);
}

TEST(ScalpelPath, SaysWhatIsWrong) {
  EXPECT_THROW(path_through({{1, 1, 1}}, up, 1), InputError);
  EXPECT_THROW(path_through({{1, 1, 1}, {1, 1, 1}}, up, 1), InputError);
  EXPECT_THROW(path_through(
                   {{0, 0, 0}, {1, 0, 0}}, [](const Vec3&) { return Vec3{}; }, 1),
               InputError);
  EXPECT_THROW(path_through({{0, 0, 0}, {0, 0, 1}}, up, 1), InputError);  // along its own N
}

TEST(ScalpelPath, ReadsATable) {
  NumberTable table{{"x", "y", "z", "nx", "ny", "nz", "depth"},
                    {{0, 0, 0, 0, 0, 2, 3}, {4, 0, 0, 0, 0, 1, 5}}};
  const ScalpelPath path = ScalpelPath::from_table(table, "path.csv");
  EXPECT_DOUBLE_EQ(path.length(), 4);
  EXPECT_NEAR(path.depth(2), 4, 1e-14);
  EXPECT_DOUBLE_EQ(norm(path.at(1).outward), 1);
  table.rows[1][6] = 0;
  EXPECT_THROW(ScalpelPath::from_table(table, "path.csv"), InputError);
  table.columns[3] = "a";
  EXPECT_THROW(ScalpelPath::from_table(table, "path.csv"), InputError);
}

}  // namespace
}  // namespace cleft
