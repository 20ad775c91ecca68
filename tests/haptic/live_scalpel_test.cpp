// The scalpel beside what draws: threads of its own, moments to draw, cuts when they have ended.
#include "explorer/scene/live_scalpel.h"

#include <gtest/gtest.h>

#include <chrono>
#include <numbers>

#include "haptic/devices/mouse.h"
#include "tests/haptic/surfaces.h"

namespace cleft {
namespace {

/// Of even pressure on a disc of radius a, by sums over rings and sectors of 1 / distance, over that in its
/// middle: (1 / 2 pi a) times the integral of dA / distance.
double sunk_by_sums(double a, double distance) {
  constexpr int rings = 2000, sectors = 2001;
  double sum = 0;
  for (int i = 0; i < rings; ++i)
    for (int j = 0; j < sectors; ++j) {
      const double r = a * (i + 0.5) / rings, angle = 2 * std::numbers::pi * j / sectors;
      sum += r * a / rings * 2 * std::numbers::pi / sectors /
             std::hypot(r * std::cos(angle) - distance, r * std::sin(angle));
    }
  return sum / (2 * std::numbers::pi * a);
}

TEST(Dent, IsThatOfAHalfSpaceUnderADisc) {
  EXPECT_NEAR(dent_profile(0), 1, 1e-12);
  EXPECT_NEAR(dent_profile(2), 2 / std::numbers::pi * (1 - 2 * 4. / 900), 1e-4) << "on the rim: 2 / pi";
  for (const double r : {0.7, 3.1, 6.3}) {
    const double to_nothing = std::pow(1 - r * r / 900, 2);
    EXPECT_NEAR(dent_profile(r) / to_nothing, sunk_by_sums(2, r), 2e-3) << r;
  }
  EXPECT_EQ(dent_profile(30), 0);
}

TEST(LiveScalpel, TellsMomentsAndEndedCuts) {
  const testing::Surface sheet = testing::flat(30, 2);
  Mouse mouse;
  LiveScalpel scalpel({sheet.points, sheet.triangles}, {}, mouse, {});
  const auto move = [&](double x, double z) {
    ScalpelPose pose;
    pose.tip = {x, 0.3, z};
    mouse.set(pose);
    std::this_thread::sleep_for(std::chrono::milliseconds(4));
  };
  const auto first = scalpel.moment();
  EXPECT_EQ(first->surface->triangles.size(), sheet.triangles.size());
  for (double z = 2; z > -5; z -= 0.2) move(-8, z);
  for (double x = -8; x < 8; x += 0.2) move(x, -5);
  for (int tries = 0; tries < 5000 && scalpel.moment()->cut_length < 13; ++tries) move(8, -5);
  EXPECT_GT(scalpel.moment()->cut_length, 13);
  EXPECT_GT(scalpel.moment()->surface->triangles.size(), sheet.triangles.size());
  EXPECT_TRUE(scalpel.ended_cuts().empty()) << "the blade is still in";
  const auto ended = scalpel.stop();
  ASSERT_EQ(ended.size(), 1u);
  EXPECT_NEAR(ended[0].front().position.x, -8, 0.05);
  EXPECT_NEAR(ended[0].back().position.x, 8, 1);
  EXPECT_NEAR(ended[0].back().depth, 5, 0.1) << "as deep as the blade was";
}

}  // namespace
}  // namespace cleft
