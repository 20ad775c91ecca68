// The scalpel next to what draws: threads of its own, moments to draw, cuts when they have ended.
#include "explorer/scalpel/live_scalpel.h"

#include <gtest/gtest.h>

#include <chrono>

#include "haptic/devices/mouse.h"
#include "tests/haptic/surfaces.h"

namespace cleft {
namespace {

TEST(LiveScalpel, TellsMomentsAndEndedCuts) {
  const testing::Surface sheet = testing::flat(30, 2);
  Mouse mouse;
  LiveScalpel scalpel({sheet.points, sheet.triangles}, {}, mouse, {});
  const auto move = [&](double x, double z) {
    ScalpelPose pose;
    pose.tip = {x, 0.3, z};
    mouse.set(pose);
    // Until the loop has felt it, however busy the machine is.
    const std::uint64_t now = scalpel.state().tick;
    while (scalpel.state().tick < now + 4) std::this_thread::sleep_for(std::chrono::milliseconds(1));
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
