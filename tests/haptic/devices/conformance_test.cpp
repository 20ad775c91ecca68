// What every device must do, whatever it is made of.
#include <gtest/gtest.h>

#include "base/error.h"
#include "haptic/loop.h"
#include "tests/haptic/devices/bench.h"
#include "tests/haptic/surfaces.h"

namespace cleft {
namespace {

using testing::Bench;
using testing::soon;

struct Kind {
  const char* name;
  std::unique_ptr<Bench> (*make)();
};

class Conformance : public ::testing::TestWithParam<Kind> {
 protected:
  Conformance() : bench(GetParam().make()) {
    start.tip = {5, 6, 7};
    device = bench->open(start);
  }
  /// A pose at the next millisecond.
  ScalpelPose read() { return device->read(time += 1e-3); }
  bool present() { return read().present; }

  std::unique_ptr<Bench> bench;
  ScalpelPose start;
  std::unique_ptr<Device> device;
  double time = 0;
};

TEST_P(Conformance, OpensWhereItWasAsked) {
  EXPECT_TRUE(soon([&] { return present() && norm(read().tip - start.tip) < 0.5; }));
  EXPECT_FALSE(read().cutting);
  EXPECT_NEAR(norm(read().axis), 1, 1e-9);
  EXPECT_NEAR(norm(read().edge), 1, 1e-9);
}

TEST_P(Conformance, StreamsPoses) {
  ASSERT_TRUE(soon([&] { return present(); }));
  bench->push(1);
  EXPECT_TRUE(soon([&] { return read().tip.x > start.tip.x + 5; }));
  EXPECT_NEAR(read().tip.y, start.tip.y, 1);
  EXPECT_NEAR(read().tip.z, start.tip.z, 1);
  const double far = read().tip.x;
  bench->push(-1);
  EXPECT_TRUE(soon([&] { return read().tip.x < far - 5; }));
}

TEST_P(Conformance, TellsTheButton) {
  ASSERT_TRUE(soon([&] { return present(); }));
  bench->press(true);
  EXPECT_TRUE(soon([&] { return read().cutting; }));
  bench->press(false);
  EXPECT_TRUE(soon([&] { return !read().cutting; }));
}

TEST_P(Conformance, RendersTheForce) {
  ASSERT_TRUE(soon([&] { return present(); }));
  device->command({0, 0, 1.5});
  if (bench->felt() < 0) return;  // no motors: being told is all
  EXPECT_TRUE(soon([&] { return bench->felt() > 0.4; }));
  device->command({});
  EXPECT_TRUE(soon([&] { return bench->felt() < 0.05; }));
}

TEST_P(Conformance, UnpluggingStopsCuttingAndComesBack) {
  ASSERT_TRUE(soon([&] { return present(); }));
  const auto surface = testing::flat(4, 10);
  const ContactSurface felt(surface.points, surface.triangles);
  HapticLoop loop(*device, felt, {});
  bench->press(true);
  const auto tick = [&] { return loop.update(1e-3), loop.state(); };
  EXPECT_TRUE(soon([&] { return tick().pose.cutting; }));
  bench->unplug();
  EXPECT_TRUE(soon([&] { return !tick().pose.present; }));
  EXPECT_FALSE(tick().pose.cutting);
  EXPECT_EQ(tick().force, Vec3{});
  bench->plug();
  EXPECT_TRUE(soon([&] { return tick().pose.present; }));
  bench->push(1);
  const double x = tick().pose.tip.x;
  EXPECT_TRUE(soon([&] { return tick().pose.tip.x > x + 2; }));
}

TEST_P(Conformance, ForcesStayBelowTheClamp) {
  ASSERT_TRUE(soon([&] { return present(); }));
  // The device stands 100 mm under a surface that holds: far more than it can render is wanted.
  auto surface = testing::flat(4, 100);
  for (Vec3& p : surface.points) p.z = start.tip.z + 1e-3;
  ContactSurface felt(surface.points, surface.triangles);
  ForceParameters p;
  p.puncture_force = 1e6;
  HapticLoop loop(*device, felt, p);
  const auto tick = [&] { return loop.update(1e-3), loop.state(); };
  ASSERT_TRUE(soon([&] { return tick().pose.present; }));
  std::vector<ContactSurface::Moved> up;
  for (int k = 1; k <= 400; ++k) {
    up.clear();
    for (std::size_t v = 0; v < surface.points.size(); ++v)
      up.push_back({static_cast<int>(v), surface.points[v] + Vec3{0, 0, 0.25 * k}});
    felt.update(up, {});
    ASSERT_LE(norm(tick().force), device->limits().max_force * (1 + 1e-12));
  }
  EXPECT_GT(loop.model().depth(), 90);
}

TEST_P(Conformance, AbsenceIsToldWithARemedy) {
  device.reset();
  bench->unplug();
  try {
    bench->open(start);
    FAIL() << "it opened";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find(bench->remedy()), std::string::npos) << e.what();
  }
  bench->plug();
}

INSTANTIATE_TEST_SUITE_P(Devices, Conformance,
                         ::testing::Values(Kind{"spacemouse", testing::spacemouse_bench},
                                           Kind{"gamepad", testing::gamepad_bench},
                                           Kind{"phantom", testing::phantom_bench},
                                           Kind{"plugin", testing::plugin_bench}),
                         [](const auto& kind) { return std::string(kind.param.name); });

}  // namespace
}  // namespace cleft
