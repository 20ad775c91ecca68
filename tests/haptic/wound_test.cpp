// A wound that opens under the blade: skin that moved is felt where it is, and not where it was.
#include <gtest/gtest.h>

#include "haptic/devices/mouse.h"
#include "haptic/loop.h"
#include "tests/haptic/surfaces.h"

namespace cleft {
namespace {

constexpr double half = 20, depth = 6;

/// A sheet cut along the x axis, with walls of the given depth; `gape` opens it evenly: lips at y = -gape / 2
/// and gape / 2.
struct Wound {
  std::vector<Vec3> points;
  std::vector<std::array<int, 3>> triangles;
  std::vector<ContactSurface::Changed> walls;
  int columns = 0;

  explicit Wound(int n) : columns(n + 1) {
    // Per column along x: left edge, left lip, bottom, right lip, right edge.
    for (int i = 0; i <= n; ++i)
      for (int k = 0; k < 5; ++k) points.push_back(place(i, k, 0));
    for (int i = 0; i < n; ++i)
      for (const int k : {0, 3}) strip(i, k);
    const auto skin = triangles.size();
    for (int i = 0; i < n; ++i)
      for (const int k : {1, 2}) strip(i, k);
    for (std::size_t t = skin; t < triangles.size(); ++t)
      walls.push_back({static_cast<int>(t), {triangles[t], true}});
  }
  void strip(int i, int k) {  // counter-clockwise from outside: above, or the wound
    const int a = 5 * i + k, b = 5 * (i + 1) + k;
    triangles.push_back({a, b, b + 1});
    triangles.push_back({a, b + 1, a + 1});
  }
  Vec3 place(int i, int k, double gape) const {
    const double x = -half + 2 * half * i / (columns - 1), y[] = {-half, -gape / 2, 0, gape / 2, half};
    return {x, y[k], k == 2 ? -depth : 0};
  }
  std::vector<ContactSurface::Moved> opened(double gape) const {
    std::vector<ContactSurface::Moved> moved;
    for (int i = 0; i < columns; ++i)
      for (const int k : {1, 3}) moved.push_back({5 * i + k, place(i, k, gape)});
    return moved;
  }
};

struct Felt {
  explicit Felt(ContactSurface& surface, const ForceParameters& p = {}) : loop(mouse, surface, p) {}
  const HapticState& go(const Vec3& tip, double speed) {
    const Vec3 from = pose.tip;
    const int ticks = std::max(1, static_cast<int>(norm(tip - from) / (speed * 1e-3)));
    for (int k = 1; k <= ticks; ++k) {
      pose.tip = lerp(from, tip, static_cast<double>(k) / ticks);
      mouse.set(pose);
      loop.update(1e-3);
      largest = std::max(largest, norm(loop.state().force));
    }
    return loop.state();
  }
  Mouse mouse;
  HapticLoop loop;
  ScalpelPose pose;
  double largest = 0;
};

TEST(Wound, OpenItMeetsNoSkinThatWasThere) {
  const Wound wound(20);
  ContactSurface surface(wound.points, wound.triangles);
  surface.update({}, wound.walls);
  for (double gape = 0.5; gape <= 6; gape += 0.5) surface.update(wound.opened(gape), {});
  Felt felt(surface);
  // Down into the middle of it, along it, and out: not a thing is touched.
  felt.pose.tip = {-10, 0, 3};
  felt.go({-10, 0, 3}, 50);
  felt.go({-10, 0, -2}, 50);
  felt.go({10, 0, -2}, 100);
  EXPECT_EQ(felt.loop.state().phase, Phase::free);
  felt.go({10, 0, 3}, 50);
  EXPECT_EQ(felt.largest, 0);
  // Beside it there is skin still, and the walls are where they moved to: at z = -2 the left one stands at -2
  // mm.
  felt.go({10, 0, -2}, 50);
  felt.pose.cutting = false;
  felt.go({10, -3, -2}, 20);
  for (int k = 0; k < 200; ++k) felt.go(felt.pose.tip, 1);
  const Vec3 force = felt.loop.state().force, normal = normalized(Vec3{0, depth, 3});
  // The wall through the lip (-3, 0) and the bottom (0, -6) stands 2 / sqrt(5) mm from (-3, -2).
  EXPECT_NEAR(norm(force), 0.3 * 2 / std::sqrt(5.), 0.05 * 0.3);
  EXPECT_GT(dot(force, normal), 0.99 * norm(force));
}

TEST(Wound, BesideAClosedCutThereIsTissue) {
  const Wound wound(20);
  ContactSurface surface(wound.points, wound.triangles);
  surface.update({}, wound.walls);
  ContactReader reader(surface);
  const ContactLook look(reader);
  for (const double y : {-1.5, -0.3, -1e-3, 1e-3, 0.3, 1.5})
    for (const double z : {-5.9, -3., -2., -7.}) {
      const NearestPoint p = reader.nearest({0.3, y, z}, 8);
      ASSERT_TRUE(p);
      EXPECT_LT(p.distance, 0) << y << ' ' << z;
      EXPECT_NEAR(norm(p.normal), 1, 1e-9);
    }
}

TEST(Wound, BesideWallsThatLieThroughEachOtherThereIsTissue) {
  // As far as a field's fit may move them, and as far as a wound is just opening.
  for (const double gape : {-5e-3, -1e-6, 1e-6, 5e-3}) {
    const Wound wound(20);
    ContactSurface surface(wound.points, wound.triangles);
    surface.update(wound.opened(gape), wound.walls);
    ContactReader reader(surface);
    const ContactLook look(reader);
    for (const double y : {-1.5, -0.3, 0.3, 1.5})
      for (const double z : {-5.9, -3., -2., -7.})
        EXPECT_LT(reader.nearest({0.3, y, z}, 8).distance, 0) << gape << ' ' << y << ' ' << z;
    EXPECT_GT(reader.nearest({0.3, 0.5, 0.1}, 8).distance, 0) << "over the skin";
  }
}

TEST(Wound, OpensAroundABladeThatCuts) {
  const Wound wound(20);
  ContactSurface surface(wound.points, wound.triangles);
  surface.update({}, wound.walls);
  ForceParameters p;
  Felt felt(surface, p);
  felt.pose.tip = {0.3, 0.05, 1};
  felt.go({0.3, 0.05, 1}, 20);
  felt.go({0.3, 0.05, -4}, 40);
  ASSERT_EQ(felt.loop.state().phase, Phase::cutting);
  // Closed, its walls hold the blade: drag.
  const double drag = norm(felt.go({5.3, 0.05, -4}, 50).force);
  EXPECT_GT(drag, 0.5 * p.drag * 50);
  for (double gape = 0.2; gape <= 8; gape += 0.2) {
    surface.update(wound.opened(gape), {});
    felt.go(felt.pose.tip + Vec3{0.05, 0, 0}, 50);
  }
  // Wide open the blade is free, whichever way it goes.
  felt.go({7, 0, -2}, 50);
  EXPECT_EQ(felt.loop.state().phase, Phase::free);
  felt.largest = 0;
  felt.go({-7, 0, -2}, 100);
  felt.go({-7, 0, 3}, 100);
  EXPECT_EQ(felt.largest, 0);
}

TEST(Wound, StepsAreAsLongAsWhatMoved) {
  // Voxels of the skin that stayed are not looked at: lists of the far half of a large sheet stay the same
  // ones.
  const auto s = testing::flat(60, 1);
  ContactSurface surface(s.points, s.triangles);
  const ContactCells& cells = surface.cells();
  const auto list_at = [&](double x, double y) {
    return cells.at(cells.index(x, 0), cells.index(y, 1), cells.index(0, 2));
  };
  std::vector<CellList> far;
  for (double x = 5; x < 29; x += 0.5) far.push_back(list_at(x, 0.2));
  std::vector<ContactSurface::Moved> moved;
  for (std::size_t v = 0; v < s.points.size(); ++v)
    if (s.points[v].x < -5) moved.push_back({static_cast<int>(v), s.points[v] - Vec3{0, 0, 3}});
  surface.update(moved, {});
  surface.update({}, {});
  std::size_t n = 0;
  for (double x = 5; x < 29; x += 0.5) EXPECT_TRUE(list_at(x, 0.2) == far[n++]);
  ContactReader reader(surface);
  const ContactLook look(reader);
  EXPECT_FALSE(reader.first_contact({-20, 0.2, 1}, {-20, 0.2, -1}, Facing::any));
  EXPECT_TRUE(reader.first_contact({-20, 0.2, -1}, {-20, 0.2, -4}, Facing::any));
}

}  // namespace
}  // namespace cleft
