// The forces are those of the model: closed forms of stiffness, drag and puncture, and what must be
// continuous.
#include <gtest/gtest.h>

#include "haptic/devices/mouse.h"
#include "haptic/loop.h"
#include "tests/haptic/surfaces.h"

namespace cleft {
namespace {

constexpr double dt = 1e-3;

DeviceLimits strong() { return {10, 10, 1, 0}; }

/// A loop whose tip is led from outside.
struct Led {
  explicit Led(const ContactSurface& surface, const ForceParameters& p = {}) : loop(mouse, surface, p) {}
  const HapticState& to(const Vec3& tip) {
    pose.tip = tip;
    mouse.set(pose);
    loop.update(dt);
    return loop.state();
  }
  /// Straight there at `speed` mm/s.
  const HapticState& go(const Vec3& tip, double speed) {
    const Vec3 from = pose.tip;
    const int ticks = std::max(1, static_cast<int>(norm(tip - from) / (speed * dt)));
    for (int k = 1; k <= ticks; ++k) to(lerp(from, tip, static_cast<double>(k) / ticks));
    return loop.state();
  }
  const HapticState& rest(int ticks) {
    for (int k = 0; k < ticks; ++k) to(pose.tip);
    return loop.state();
  }
  Mouse mouse;
  HapticLoop loop;
  ScalpelPose pose;
};

TEST(Force, NoneInTheAir) {
  const auto s = testing::ball(12, 10, 0.1);
  const ContactSurface surface(s.points, s.triangles);
  Led led(surface);
  std::mt19937 random(1);
  std::normal_distribution<double> step(0, 0.3);
  Vec3 x{0, 0, 14};
  for (int n = 0; n < 5000; ++n) {
    Vec3 next = x + Vec3{step(random), step(random), step(random)};
    if (norm(next) < 12 || next.z < 8) continue;
    x = next;
    led.pose.axis = normalized(x);
    ASSERT_EQ(norm(led.to(x).force), 0);
  }
}

TEST(Force, StaticStiffnessIsTheModels) {
  const auto s = testing::flat(20, 1);
  const ContactSurface surface(s.points, s.triangles);
  for (const double stiffness : {0.05, 0.2, 0.4}) {
    ForceParameters p;
    p.stiffness = stiffness;
    Led led(surface, p);
    led.to({0.3, 0.2, 1});
    for (const double depth : {0.2, 0.5, 1., 1.5}) {
      led.go({0.3, 0.2, -depth}, 10);
      const Vec3 force = led.rest(300).force;
      EXPECT_NEAR(force.z, stiffness * depth, 0.05 * stiffness * depth) << stiffness << ' ' << depth;
      EXPECT_NEAR(force.x, 0, 1e-9);
      EXPECT_NEAR(force.y, 0, 1e-9);
    }
    // And back: the same forces, none outside.
    led.go({0.3, 0.2, -0.5}, 10);
    EXPECT_NEAR(led.rest(300).force.z, stiffness * 0.5, 0.05 * stiffness * 0.5);
    led.go({0.3, 0.2, 0.1}, 10);
    EXPECT_EQ(norm(led.rest(50).force), 0);
  }
}

TEST(Force, IsThatOfThePlace) {
  // Firmness grows along x from 1 at -5 to 2 at 5, and is 3 on a far corner that is never felt.
  const auto s = testing::flat(20, 1);
  ContactSurfaceOptions options;
  for (const Vec3& p : s.points)
    options.firmness.push_back(static_cast<float>(std::clamp(1.5 + p.x / 10, 1., 2.)));
  options.firmness.back() = 3;
  ContactSurface surface(s.points, s.triangles, options);
  ForceParameters p;
  p.stiffness = 0.1;
  Led led(surface, p);
  for (const double x : {-7.2, -2.3, 0.4, 3.7, 6.1}) {
    led.go({x, 0.2, 1}, 50);
    led.go({x, 0.2, -1.2}, 10);
    const double expected = 0.1 * std::clamp(1.5 + x / 10, 1., 2.) * 1.2;
    EXPECT_NEAR(led.rest(300).force.z, expected, 0.05 * expected) << x;
  }
  EXPECT_LE(led.loop.statistics().excess_change, 0);
  // It stays with its vertices while they move, and goes to new ones.
  const std::vector<ContactSurface::Moved> moved{{0, {-10, -10, 0.5}},
                                                 {static_cast<int>(s.points.size()), {0, 0, 3}, 2.F}};
  surface.update(moved, {});
  led.go({6.1, 0.2, 1}, 50);
  led.go({6.1, 0.2, -1.2}, 10);
  EXPECT_NEAR(led.rest(300).force.z, 0.24, 0.012);
  led.go({6.1, 0.2, -4.5}, 10);
  EXPECT_NEAR(led.loop.model().puncture_stiffness()[1], 0.2, 1e-9);
  EXPECT_NEAR(led.loop.model().stiffness(), 0.1, 1e-12);
}

TEST(Force, TremorDoesNotWearTheStiffnessDown) {
  // A minute of 8 Hz, 0.3 mm: a force held through each tick would give K T / 2 v^2 back to the hand all the
  // time, and empty the tank that pays for it: the model's damping of that size takes it away again.
  const auto s = testing::flat(20, 1);
  const ContactSurface surface(s.points, s.triangles);
  Led led(surface);
  led.to({0.3, 0.2, 1});
  led.go({0.3, 0.2, -1}, 10);
  led.rest(100);
  double worst = 0;
  for (int n = 0; n < 60000; ++n) {
    const double depth = 1 + 0.3 * std::sin(2 * std::numbers::pi * 8e-3 * n);
    worst = std::max(worst, std::abs(led.to({0.3, 0.2, -depth}).force.z / (0.3 * depth) - 1));
  }
  EXPECT_LT(worst, 0.05);
}

TEST(Force, DragIsTheModels) {
  const auto s = testing::flat(60, 1);
  const ContactSurface surface(s.points, s.triangles);
  ForceParameters p;
  p.cutting_resistance = 0;
  for (const double speed : {20., 50., 100.}) {
    Led led(surface, p);
    led.to({-25, 0.2, 1});
    led.go({-25, 0.2, -5}, 20);
    ASSERT_EQ(led.loop.state().phase, Phase::cutting);
    led.rest(200);
    EXPECT_NEAR(norm(led.loop.state().force), 0, p.floor);
    led.go({-25 + 0.4 * speed, 0.2, -5}, speed);
    const Vec3 force = led.loop.state().force;
    EXPECT_NEAR(force.x, -p.drag * speed, 0.05 * p.drag * speed);
    EXPECT_LT(std::hypot(force.y, force.z), 1e-6);
  }
}

TEST(Force, CuttingResistanceIsTheModels) {
  const auto s = testing::flat(60, 1);
  const ContactSurface surface(s.points, s.triangles);
  ForceParameters p;
  p.drag = 0;
  Led led(surface, p);
  led.to({-25, 0.2, 1});
  led.go({-25, 0.2, -6}, 20);
  led.rest(200);
  led.go({0, 0.2, -6}, 50);
  EXPECT_NEAR(led.loop.state().force.x, -p.cutting_resistance * 6, 0.05 * p.cutting_resistance * 6);
}

TEST(Force, PunctureThresholdRampAndExit) {
  const auto s = testing::flat(40, 1);
  const ContactSurface surface(s.points, s.triangles);
  const ForceParameters p;
  Led led(surface, p);
  led.to({0.3, 0.2, 0.5});
  double highest = 0;
  int ticks = 0;
  while (led.loop.state().punctures == 0 && ++ticks < 5000)
    highest = std::max(highest, norm(led.to(led.pose.tip - Vec3{0, 0, 0.01}).force));
  ASSERT_EQ(led.loop.state().punctures, 1);
  EXPECT_GE(highest, 0.5);
  EXPECT_LE(highest, 1.2);
  EXPECT_NEAR(led.loop.model().last_puncture_force(), p.puncture_force, 0.01);
  // After the stated time, and the ticks the permitted change still needs, there is drag alone.
  double before = norm(led.loop.state().force);
  for (int k = 0; k < static_cast<int>(p.puncture_time / dt) + 20; ++k) {
    const double force = norm(led.rest(1).force);
    EXPECT_LE(before - force, 0.07 * before + p.floor + 1e-12);
    before = force;
  }
  EXPECT_LE(before, p.floor);
  // Out again: free in the air, and a second contact has to be punctured again.
  led.go({0.3, 0.2, 2}, 20);
  EXPECT_EQ(led.rest(50).phase, Phase::free);
  led.go({0.3, 0.2, -1}, 20);
  EXPECT_EQ(led.loop.state().phase, Phase::contact);
}

/// The model alone, without the passivity controller whose own limit would hide a force that jumps. The tip
/// slides at `speed` mm/s, 3 mm under a flat sheet, and the sheet gives way once everything is stationary.
struct Slide {
  explicit Slide(double speed) : moved{dt * speed, 0, 0}, model(surface, p, strong(), 0) {
    pose.tip = {-20, 0.2, 1};
    pose.cutting = false;
    model.update(pose, dt);
    for (int k = 0; k < 400; ++k) pose.tip.z -= 0.01, model.update(pose, dt);
    for (int k = 0; k < 200; ++k) pose.tip += moved, model.update(pose, dt);  // 40 times the filter's time
    pose.cutting = true;
    at_puncture = tick();
  }
  Vec3 tick() {
    pose.tip += moved;
    return model.update(pose, dt);
  }
  ForceParameters p;
  testing::Surface sheet = testing::flat(60, 1);
  ContactSurface surface{sheet.points, sheet.triangles};
  Vec3 moved;
  ForceModel model;
  ScalpelPose pose;
  Vec3 at_puncture;
};

TEST(Force, FadesOverThePunctureTime) {
  // F(t) = (1 - g) F_puncture + g F_cutting and the stored energy (1 - g)^2 F_puncture^2 / 2 K, with
  // g = 3 x^2 - 2 x^3 of x = t / puncture_time, for a blade at rest and one that slides along its edge.
  for (const double speed : {0., 40.}) {
    Slide slide(speed);
    const ForceParameters& p = slide.p;
    const double depth = 3, elastic = p.stiffness * depth;
    ASSERT_EQ(slide.model.punctures(), 1);
    EXPECT_NEAR(slide.at_puncture.z, elastic, 1e-9);
    const double cutting =
        -p.drag * speed - p.cutting_resistance * depth * std::tanh(speed / p.resistance_speed);
    const int ticks = static_cast<int>(std::lround(p.puncture_time / dt));
    for (int k = 1; k <= ticks + 5; ++k) {
      const double x = std::min(1., static_cast<double>(k) / ticks), g = x * x * (3 - 2 * x);
      const Vec3 force = slide.tick();
      EXPECT_NEAR(force.z, (1 - g) * elastic, 1e-9) << "tick " << k << " at " << speed << " mm/s";
      EXPECT_NEAR(force.x, g * cutting, 1e-9) << "tick " << k << " at " << speed << " mm/s";
      EXPECT_NEAR(slide.model.stored(), (1 - g) * (1 - g) * elastic * elastic / (2 * p.stiffness), 1e-9);
    }
  }
}

TEST(Force, OneLeapOutOfTheTissueIsOut) {
  const auto s = testing::flat(20, 1);
  const ContactSurface surface(s.points, s.triangles);
  Led led(surface);
  led.to({0.3, 0.2, 1});
  led.go({0.3, 0.2, -5}, 20);
  led.rest(100);
  ASSERT_EQ(led.loop.state().phase, Phase::cutting);
  led.to({0.3, 0.2, 4});  // from far under the skin to far above it
  EXPECT_EQ(led.rest(50).phase, Phase::free);
  led.go({0.3, 0.2, -1}, 10);
  EXPECT_EQ(led.loop.state().phase, Phase::contact) << "and it can be felt again";
}

TEST(Force, ALeapThroughAClosedWoundStaysInTheTissue) {
  // Two walls on each other across the way, from the skin down to -8.
  auto s = testing::flat(20, 1);
  const int first = static_cast<int>(s.points.size()), skin = static_cast<int>(s.triangles.size());
  for (const Vec3& p : {Vec3{0.1, -9, 0}, Vec3{0.1, 9, 0}, Vec3{0.1, 0, -16}}) s.points.push_back(p);
  s.triangles.push_back({first, first + 1, first + 2});
  s.triangles.push_back({first, first + 2, first + 1});
  ContactSurface surface(s.points, s.triangles);
  const ContactSurface::Changed walls[] = {
      {skin, {s.triangles[skin], true}}, {skin + 1, {s.triangles[static_cast<std::size_t>(skin) + 1], true}}};
  surface.update({}, walls);
  Led led(surface);
  led.to({-3.3, 0.2, 1});
  led.go({-3.3, 0.2, -5}, 20);
  led.rest(100);
  ASSERT_EQ(led.loop.state().phase, Phase::cutting);
  led.to({3.4, 0.2, -5});
  EXPECT_EQ(led.rest(50).phase, Phase::cutting);
  led.to({-3.4, 0.2, 4});  // back through it and out of the skin at once
  EXPECT_EQ(led.rest(50).phase, Phase::free);
}

TEST(Force, ALeapOutThroughAnOpenWoundIsOut) {
  for (const double half : {4., 0.1}) {  // of the width of a wound along y, 8 mm deep
    SCOPED_TRACE(half);
    const std::vector<Vec3> points{{-20, -20, 0},  {-half, -20, 0}, {-half, 20, 0}, {-20, 20, 0},
                                   {half, -20, 0}, {20, -20, 0},    {20, 20, 0},    {half, 20, 0},
                                   {0, -20, -8},   {0, 20, -8}};
    const std::vector<std::array<int, 3>> triangles{{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7},
                                                    {1, 8, 9}, {1, 9, 2}, {8, 4, 7}, {8, 7, 9}};
    ContactSurface surface(points, triangles);
    std::vector<ContactSurface::Changed> walls;
    for (int t = 4; t < 8; ++t) walls.push_back({t, {triangles[static_cast<std::size_t>(t)], true}});
    surface.update({}, walls);
    Led led(surface);
    led.to({-7.3, 0.2, 1});
    led.go({-7.3, 0.2, -4}, 20);
    led.rest(100);
    ASSERT_EQ(led.loop.state().phase, Phase::cutting);
    led.to({0, 0.2, -4});  // through a wall into the wound
    led.to({0, 0.2, 4});
    EXPECT_EQ(led.rest(50).phase, Phase::free);
  }
}

TEST(Force, WithoutTheButtonNothingIsPunctured) {
  const auto s = testing::flat(20, 1);
  const ContactSurface surface(s.points, s.triangles);
  Led led(surface);
  led.pose.cutting = false;
  led.to({0.3, 0.2, 0.5});
  led.go({0.3, 0.2, -8}, 20);
  EXPECT_EQ(led.loop.state().punctures, 0);
  EXPECT_EQ(led.loop.state().phase, Phase::contact);
}

TEST(Force, ContinuousOverSeamsOfACurvedSurface) {
  // Slowly under the surface at constant radius: a step of the tip changes direction and size of the force by
  // no more than the step over the radius of curvature does, times what interpolated normals bend faster than
  // the ball.
  const double radius = 20, stiffness = 0.3;
  const auto s = testing::ball(10, radius);
  const ContactSurface surface(s.points, s.triangles);
  ForceParameters p;
  p.puncture_force = 100;
  ForceModel model(surface, p, strong(), 0);  // no damping: the static force
  ScalpelPose pose;
  const double step = 0.002;  // rad: 0.04 mm, over 600 seams in all
  Vec3 last;
  double largest = 0;
  for (int n = 0; n < 6000; ++n) {
    const double a = 0.9 + 0.5 * std::sin(0.37 * step * n), b = step * n;
    const double r = n < 100 ? radius + 1 - 0.025 * n : radius - 1.5;
    pose.tip = r * Vec3{std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a)};
    const Vec3 force = model.update(pose, dt);
    if (n > 100) largest = std::max(largest, norm(force - last));
    ASSERT_TRUE(n <= 100 || norm(force) > 0.2 * stiffness) << n;
    last = force;
  }
  // Faces of 6 mm turn by 18 degrees from seam to seam. Without interpolation a seam would change a force of
  // 0.4 N by 0.4 sin(18 deg) = 0.12 N at once; spread evenly over the faces, 0.04 mm of way turn it by 0.4 *
  // 0.04 / 20 = 0.001 N and the chord's slope, 9 degrees, changes the depth by 0.006 mm.
  EXPECT_LT(largest, 2 * (0.0008 + stiffness * 0.0064));
}

TEST(Force, ThinPartsHold) {
  // Two sheets half a millimetre apart, both facing out: the proxy stays on the side it came from.
  auto s = testing::flat(20, 1);
  const int count = static_cast<int>(s.points.size());
  for (int v = 0; v < count; ++v) s.points.push_back(s.points[v] - Vec3{0, 0, 0.5});
  const auto triangles = s.triangles;
  for (const auto& [a, b, c] : triangles) s.triangles.push_back({a + count, c + count, b + count});
  const ContactSurface surface(s.points, s.triangles);
  ForceParameters p;
  p.puncture_force = 100;
  Led led(surface, p);
  led.to({0.3, 0.2, 1});
  led.go({0.3, 0.2, -3}, 20);
  led.go({4.3, -2.2, -3}, 20);
  EXPECT_NEAR(led.rest(300).force.z, 0.3 * 3, 0.05 * 0.3 * 3);
}

TEST(Force, BladesSideFindsTheEdge) {
  // The tip hangs in the air next to a cube-like sheet's end while the blade lies across it.
  const auto s = testing::ball(16, 10);
  const ContactSurface surface(s.points, s.triangles);
  Led led(surface);
  led.pose.axis = {1, 0, 0};
  led.to({-5, 0, 10.6});
  EXPECT_EQ(norm(led.loop.state().force), 0);
  const HapticState& state = led.go({-5, 0, 9.7}, 5);
  EXPECT_EQ(state.phase, Phase::free);
  EXPECT_NEAR(led.rest(100).force.z, 0.3 * 0.3, 0.02);  // the ball's top stands 0.3 mm above the blade
  // The nearest face leans by up to the angle from ring to ring.
  const Vec3 force = led.loop.state().force;
  EXPECT_LT(std::abs(force.y), force.z * std::sin(std::numbers::pi / 16));
}

}  // namespace
}  // namespace cleft
