// Places beside a path that change smoothly, and the room that displacements have to fall in.
#include "explorer/wound/room.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <random>

#include "tests/incision/meshes.h"
#include "tests/wound/fields.h"

namespace cleft {
namespace {

TEST(SteadyPlace, IsTheFootBesideAStraightPathToTheBit) {
  const ScalpelPath path = testing::path_through({{-15, 1, 0}, {-3, 1, 0}, {15, 1, 0}}, testing::up, 3);
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> place(-25, 25);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 x{place(random), place(random), 0};
    const PathCoordinates at = path.coordinates(x);
    EXPECT_EQ(path.steady_place(x, at), at.s);
    EXPECT_NEAR(at.s, x.x + 15, 1e-9);
  }
}

/// On either side of an arc a place's own radius leads to its foot, by symmetry.
TEST(SteadyPlace, IsTheFootBesideAnArc) {
  constexpr double radius = 20;
  std::vector<Vec3> points;
  for (int i = 0; i <= 90; ++i)
    points.push_back({radius * std::cos(i * 0.02), radius * std::sin(i * 0.02), 0});
  const ScalpelPath path = testing::path_through(points, testing::up, 3);
  for (const double r : {12., 16., 19., 20., 22., 26.})
    for (const double angle : {0.8, 0.9, 1.}) {
      const Vec3 x{r * std::cos(angle), r * std::sin(angle), 0};
      EXPECT_NEAR(path.steady_place(x, path.coordinates(x)), radius * angle, 0.02) << r;
    }
}

/// Beside a path that trembles the nearest place jumps from bend to bend; the mean does not.
TEST(SteadyPlace, DoesNotJumpBesideATremor) {
  std::vector<Vec3> points;
  for (int i = 0; i <= 120; ++i) points.push_back({-15 + i * 0.25, 0.06 * std::sin(i * 0.25 * 8), 0});
  const ScalpelPath path = testing::path_through(points, testing::up, 3);
  double nearest = 0, steady = 0;
  for (double x = -10; x < 10; x += 0.01) {
    const Vec3 a{x, 1, 0}, b{x + 0.01, 1, 0};
    nearest = std::max(nearest, path.coordinates(b).s - path.coordinates(a).s);
    steady = std::max(steady, std::abs(path.steady_place(b, path.coordinates(b)) -
                                       path.steady_place(a, path.coordinates(a))));
  }
  EXPECT_GT(nearest, 0.1);
  EXPECT_LT(steady, 0.05);
}

TEST(NearestPlace, IsThatOfBruteForce) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> place(-1, 1);
  std::vector<Vec3> places(300);
  for (Vec3& p : places) p = {place(random), place(random), 0.1 * place(random)};
  const NearestPlace nearest(places);
  for (int i = 0; i < 500; ++i) {
    const Vec3 x{2 * place(random), 2 * place(random), place(random)};
    double least = 0.5;
    for (const Vec3& p : places) least = std::min(least, norm(p - x));
    EXPECT_EQ(nearest.distance(x, 0.5), least);
  }
  EXPECT_EQ(NearestPlace().distance({0, 0, 0}, 7), 7);
}

/// Inside a bend there is little room; outside of it, beside the path, there is plenty. Around the end of the
/// cut both sides hang together.
TEST(WoundRoom, OfBothSidesIsTheSameAroundTheEndsOfACut) {
  const Field field = testing::opening_field({-15, 30, 3}, 60, 40, 8, 40);
  constexpr double radius = 3;
  std::vector<Vec3> points;
  for (int i = 0; i <= 60; ++i) {
    const double angle = i * 0.04;
    points.push_back({radius * std::cos(angle), radius * std::sin(angle), 0});
  }
  const Incision cut(testing::grid(60, 60, -30, -30, 1), testing::path_through(points, testing::up, 3));
  const WoundRoom room(cut, VaryingField(field), 1);
  for (const double s : {0., cut.path().length()}) {
    const PathFrame end = cut.path().at(s);
    const double at_end = room.weight({end.position, s, 0, 0, Side::both});
    for (const double v : {-0.01, 0.01}) {
      const Side side = v < 0 ? Side::left : Side::right;
      EXPECT_NEAR(room.weight({end.position + v * end.across, s, v, v, side}), at_end, 0.02);
    }
    EXPECT_LT(at_end, 0.9);
    const double far = end.across.x * std::cos(s / radius) > 0 ? 20 : -20;
    EXPECT_EQ(room.weight({end.position + far * end.across, s, far, far, far < 0 ? Side::left : Side::right}),
              1);
  }
}

/// At the centre of an arc the nearest place of the path jumps. A straight cut's field moves nothing there; a
/// family's as far as what it says of both places is nearly the same, in space.
TEST(WoundRoom, OfAFamilyIsLittleOnlyWhereItsDisplacementsDiffer) {
  constexpr double radius = 10;
  std::vector<Vec3> points;
  for (int i = 0; i <= 60; ++i)
    points.push_back({radius * std::cos(i * 0.04), radius * std::sin(i * 0.04), 0});
  const Incision cut(testing::grid(60, 60, -30, -30, 1), testing::path_through(points, testing::up, 3));
  const double s = cut.path().length() / 2;
  const PathFrame middle = cut.path().at(s);
  const auto weight = [&](const VaryingField& field, double inward) {
    const WoundRoom room(cut, field, 1);
    return room.weight({middle.position + inward * middle.across, s, inward, inward, Side::right});
  };
  for (const bool wide : {false, true}) {
    const Field field = testing::opening_field({-15, 30, 3}, 60, 40, 8, wide ? 4 : 0.4);
    const VaryingField family(std::make_shared<const Field>(field),
                              {{s, std::make_shared<const Field>(field), {}, middle.along}});
    EXPECT_EQ(weight(field, radius), 0);
    if (wide)
      EXPECT_LT(weight(family, radius), 0.1);
    else
      EXPECT_EQ(weight(family, radius), 1);
    EXPECT_GT(weight(family, radius / 2), 0.9);
  }
}

TEST(RoomAlong, ChangesByNoMoreThanTheWay) {
  RoomAlong room;
  for (int i = 0; i <= 20; ++i) room.push_back(i, i == 7 ? 0.5 : 100);
  room.even_out();
  for (double s = -2; s < 25; s += 0.1) EXPECT_NEAR(room.at(s), std::min(0.5 + std::abs(s - 7), 100.), 1e-12);
  EXPECT_EQ(RoomAlong().at(3), std::numeric_limits<double>::infinity());
}

TEST(LargestDisplacement, IsNoLessThanTheFieldsAndFallsAwayFromTheCut) {
  const Field field = testing::opening_field({-5, 10, 3}, 20, 16, 6, 2);
  const LargestDisplacement largest(field, 10), half(field, 5);
  EXPECT_LT(half.anywhere(), largest.anywhere());
  EXPECT_GT(half.anywhere(), 0.1 * largest.anywhere());
  for (double v = -8; v <= 8; v += 0.4)
    for (double u = -10; u <= 10; u += 0.3) {
      double most = 0;
      for (double t = 0.5; t <= 10; t += 0.5)
        most = std::max(most, norm(field.displacement({u, v, 0}, v < 0 ? Side::left : Side::right, t)));
      EXPECT_GE(largest.at(u, v), 0.97 * most) << u << ' ' << v;
      EXPECT_LE(largest.at(u, v), largest.anywhere());
    }
  EXPECT_LT(largest.at(-9, 6), 0.2 * largest.at(0, 0));
  EXPECT_EQ(LargestDisplacement().at(0, 0), 0);
}

}  // namespace
}  // namespace cleft
