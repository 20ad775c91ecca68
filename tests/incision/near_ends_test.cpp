// Ends of cuts that all but meet another cut are led on to it; others stay as they are.
#include "explorer/incision/near_ends.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "tests/incision/meshes.h"

namespace cleft {
namespace {

using namespace testing;

constexpr double y = 0.31, near = narrowest_bridge;

ScalpelPath along() { return path_through({{-10, y, 0}, {-3, y, 0}, {4, y, 0}, {10, y, 0}}, up, 2); }

/// From below, at an angle to the other path, to so far before it.
ScalpelPath branch(double gap, double degrees = 90, double x = 1.13) {
  const double angle = degrees * std::numbers::pi / 180;
  const Vec3 way{std::cos(angle), std::sin(angle), 0}, end{x, y - gap, 0};
  return path_through({end - 8 * way, end - 4 * way, end - 1 * way, end}, up, 2);
}

ScalpelPath turned_round(const ScalpelPath& path) {
  std::vector<Vec3> points;
  for (const double s : path.given()) points.insert(points.begin(), path.at(s).position);
  return path_through(points, up, 2);
}

/// Whether the last place of the last of the cuts is open, as it is at a T.
bool ends_open(const std::vector<ScalpelPath>& paths) {
  CutMesh mesh(grid(20, 20, -15, -15, 1.5));
  std::vector<std::unique_ptr<Incision>> cuts;
  for (const ScalpelPath& path : paths) {
    cuts.push_back(std::make_unique<Incision>(mesh, path));
    cuts.back()->advance_to(path.length());
  }
  return cuts.back()->chain().back().left != cuts.back()->chain().back().right;
}

TEST(NearEnds, AreLedOverTheOtherCut) {
  for (const double degrees : {90., 60., 150., 20.})
    for (const double gap : {0.001, 0.02, 0.049})
      for (const bool start : {false, true}) {
        const ScalpelPath before = start ? turned_round(branch(gap, degrees)) : branch(gap, degrees);
        const JoinedPaths joined = with_near_ends_joined({along(), before}, near);
        ASSERT_EQ(joined.ends.size(), 1U) << degrees << ' ' << gap;
        const JoinedEnd& one = joined.ends.front();
        EXPECT_EQ(one.cut, 1);
        EXPECT_EQ(one.other, 0);
        EXPECT_EQ(one.start, start);
        EXPECT_NEAR(one.gap, gap, 1e-6);
        const ScalpelPath& path = joined.paths[1];
        const double end = path.at(start ? 0 : path.length()).position.y;
        EXPECT_GT(end, y + 0.1 * near);
        EXPECT_LT(end, y + 0.4 * near);
        EXPECT_LT(norm(path.at(start ? path.length() : 0).position -
                       before.at(start ? before.length() : 0).position),
                  1e-9);
        EXPECT_LT(norm(path.at(4).position - before.at(4).position), 0.3) << "the same way";
        EXPECT_EQ(path.depth(1), 2);
      }
  EXPECT_FALSE(ends_open({along(), branch(0.02)})) << "a bridge";
  EXPECT_TRUE(ends_open(with_near_ends_joined({along(), branch(0.02)}, near).paths));
  const JoinedPaths on_it = with_near_ends_joined({along(), branch(0)}, near);
  EXPECT_EQ(on_it.ends.size(), 0U);
  EXPECT_GT(on_it.paths[1].at(on_it.paths[1].length()).position.y, y);
  EXPECT_TRUE(ends_open(on_it.paths));
  // Whichever is cut first.
  EXPECT_EQ(with_near_ends_joined({branch(0.02), along()}, near).ends.size(), 1U);
}

TEST(NearEnds, AreLedOnWhereverTheWidestBridgeIs) {
  for (const double at : {0.31, 1., 6., 10., -17.3}) {
    const ScalpelPath other = path_through({{-10, at, 0}, {10, at, 0}}, up, 2),
                      before = path_through({{1, at - 8, 0}, {1, at - near, 0}}, up, 2);
    EXPECT_EQ(with_near_ends_joined({other, before}, near).ends.size(), 1U) << at;
  }
}

TEST(NearEnds, OthersStayAsTheyAre) {
  const auto joined = [](const ScalpelPath& path) {
    return with_near_ends_joined({along(), path}, near).ends.size();
  };
  EXPECT_EQ(joined(branch(0.06)), 0U) << "farther";
  EXPECT_EQ(joined(branch(-0.02)), 0U) << "it crosses";
  EXPECT_EQ(joined(branch(0.02, 5)), 0U) << "beside it";
  EXPECT_EQ(joined(branch(0.02, 90, 10.5)), 0U) << "ahead of the other one's end";
  EXPECT_EQ(joined(branch(0.02, 270)), 0U) << "it comes from beyond, and sticks out";
  EXPECT_EQ(with_near_ends_joined({branch(0.02)}, near).ends.size(), 0U);
}

TEST(NearEnds, TellHowFarItIsStraightOnOverTheOtherPath) {
  constexpr double ahead = 1, beyond = 0.01;
  const auto way = [](const ScalpelPath& path, bool start = false) {
    return way_over(path, start, along(), ahead, beyond);
  };
  for (const double degrees : {90., 60., 150., 20.})
    for (const double gap : {0.001, 0.1, 0.3}) {
      const double expected = (gap + beyond) / std::sin(degrees * std::numbers::pi / 180);
      const ScalpelPath path = branch(gap, degrees);
      ASSERT_TRUE(way(path).has_value()) << degrees << ' ' << gap;
      EXPECT_NEAR(*way(path), expected, 1e-6);
      ASSERT_TRUE(way(turned_round(path), true).has_value());
      EXPECT_NEAR(*way(turned_round(path), true), expected, 1e-6);
      EXPECT_FALSE(way(path, true).has_value()) << "its other end is far";
    }
  EXPECT_FALSE(way(branch(0.6, 30)).has_value()) << "1.2 mm on";
  EXPECT_FALSE(way(branch(-0.02)).has_value()) << "it has crossed";
  EXPECT_FALSE(way(branch(0.02, 5)).has_value()) << "beside it";
  EXPECT_FALSE(way(branch(0.02, 90, 10.5)).has_value()) << "ahead of the other one's end";
  EXPECT_FALSE(way(branch(0.02, 270)).has_value()) << "it goes away";
}

}  // namespace
}  // namespace cleft
