// The wound kept up step by step is the one that a look at the whole mesh gives.
#include "explorer/wound/live_replay.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "explorer/wound/replay.h"
#include "tests/incision/meshes.h"
#include "tests/wound/fields.h"

namespace cleft {
namespace {

using namespace testing;

double hills(double x, double y) { return 2 * std::sin(0.2 * x) * std::cos(0.15 * y); }
Vec3 up_on_hills(const Vec3& p) {
  return normalized({-0.4 * std::cos(0.2 * p.x) * std::cos(0.15 * p.y),
                     0.3 * std::sin(0.2 * p.x) * std::sin(0.15 * p.y), 1});
}

ScalpelPath winding(double from, double to) {
  std::vector<Vec3> points;
  for (double x = from; x <= to; x += 0.5)
    points.push_back({x, 3 * std::sin(0.25 * x), hills(x, 3 * std::sin(0.25 * x))});
  return path_through(points, up_on_hills, 1.5);
}

void expect_same(const LiveReplay& live, const Field& field, const Incision& incision, double s) {
  const Replay whole(Wound(incision, field, 1));
  ASSERT_EQ(live.vertex_count(), whole.vertex_count());
  std::vector<Vec3> positions(whole.vertex_count());
  whole.positions(s, positions);
  for (std::size_t v = 0; v < positions.size(); ++v)
    ASSERT_EQ(live.position(static_cast<int>(v)), positions[v]) << "vertex " << v << " at s = " << s;
}

class LiveReplays : public ::testing::TestWithParam<double> {};

TEST_P(LiveReplays, AreReplaysBitForBitWhateverTheSteps) {
  const Field field = opening_field({-5, 10, 3}, 20, 16, 6, 2);
  for (unsigned seed = 0; seed < 4; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> part(0, 1);
    IncisionOptions options;
    if (seed % 2 == 0) options.max_edge = 0;
    Incision incision(grid(60, 40, -30, -20, 1, hills), winding(-GetParam() / 2, GetParam() / 2), options);
    Wound wound(incision, field, 1);
    LiveReplay live(wound);
    const double length = incision.path().length();
    for (int step = 0; step < 25; ++step) {
      const double dice = part(random);
      if (incision.undone()) {
        incision.redo();
      } else if (dice < 0.1) {
        incision.undo();
      } else {
        incision.advance_to(incision.tip() + 0.15 * length * part(random) * part(random));
      }
      live.follow();
      if (incision.undone()) {
        for (std::size_t v = 0; v < live.vertex_count(); ++v)
          ASSERT_EQ(live.position(static_cast<int>(v)), incision.mesh().position(static_cast<int>(v)));
        continue;
      }
      const double s = dice < 0.3 ? incision.tip() * part(random) : incision.tip();  // looks back at times
      live.move_to(s);
      expect_same(live, field, incision, s);
    }
  }
}
INSTANTIATE_TEST_SUITE_P(ShorterAndLongerThanTheField, LiveReplays, ::testing::Values(8., 42.));

TEST(LiveReplay, FollowsAPathFromVertexToVertex) {
  const Field field = opening_field({-5, 10, 3}, 20, 16, 6, 2);
  IncisionOptions options;
  options.max_edge = 0;
  Incision incision(grid(20, 16, -10, -8, 1), path_through({{-5, 0, 0}, {5, 0, 0}}, up, 1.5), options);
  Wound wound(incision, field, 1);
  LiveReplay live(wound);
  for (double s = 0.5; s <= 10; s += 0.5) {
    incision.advance_to(s);
    live.follow();
    live.move_to(s);
    expect_same(live, field, incision, s);
  }
}

TEST(LiveReplay, EntersAFewAtATimeAndIsAReplayOnceAllHave) {
  const Field field = opening_field({-5, 10, 3}, 20, 16, 6, 2);
  Incision incision(grid(60, 40, -30, -20, 1, hills), winding(-8, 8), {});
  constexpr std::size_t most = 40;
  Wound wound(incision, field, 1);
  LiveReplay live(wound, most);
  for (double s = 1; s <= 10; s += 1.5) {
    incision.advance_to(s);
    live.follow();
    EXPECT_LE(live.contracted(), most);
    live.move_to(s);
  }
  ASSERT_GT(live.late(), 2 * most);
  const double tip = incision.tip();
  for (std::size_t left = live.late(); left > 0; left = live.late()) {
    live.move_to(tip);
    ASSERT_LT(live.late(), left);
  }
  expect_same(live, field, incision, tip);
}

TEST(LiveReplay, StepsCostWhatIsNewAndFramesWhatMoves) {
  const Field field = opening_field({-5, 10, 3}, 20, 16, 6, 2);
  IncisionOptions options;
  options.max_edge = 0;
  Incision incision(grid(200, 40, -100, -20, 1), path_through({{-90, 0.3, 0}, {90, 0.3, 0}}, up, 1.5),
                    options);
  Wound wound(incision, field, 1);
  LiveReplay live(wound);
  const auto advance = [&](double s) {
    incision.advance_to(s);
    live.follow();
    const std::size_t contracted = live.contracted();
    live.move_to(s);
    return std::pair(contracted, live.touched().size());
  };
  advance(60);
  const std::size_t active = live.active();
  // In the steady state a millimetre brings a millimetre of skin, 25 wide with the margin, and the wall's
  // columns.
  const auto [contracted, moving] = advance(61);
  EXPECT_GT(contracted, 0u);
  EXPECT_LT(contracted, 60u);
  EXPECT_LT(live.active(), active + 80);
  // Own times of 10 mm are under way.
  EXPECT_LT(moving, 10 * 25 + 200u);
  EXPECT_GT(live.active(), 60 * 25u);
}

}  // namespace
}  // namespace cleft
