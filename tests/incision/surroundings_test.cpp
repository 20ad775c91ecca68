// On which side of the path vertices are, against the sides that plane geometry knows. Paths that run through
// vertices and along edges of a regular mesh are where the sign of a rounded number would decide.
#include <gtest/gtest.h>

#include <cmath>

#include "explorer/incision/incision.h"
#include "tests/incision/meshes.h"

namespace cleft {
namespace {

using namespace testing;

constexpr double pi = std::numbers::pi;

/// An arc about the origin, counter-clockwise from `begin`, in the plate's own plane.
ScalpelPath arc(double radius, double begin, double end) {
  std::vector<Vec3> points;
  for (int i = 0; i <= 72; ++i) {
    const double angle = begin + (end - begin) * i / 72;
    points.push_back({radius * std::cos(angle), radius * std::sin(angle), 0});
  }
  return path_through(points, up, 1);
}

struct Arc {
  const char* name;
  double radius, begin, end;
};

class SidesOfArcs : public ::testing::TestWithParam<Arc> {};

constexpr double edge =
    1.2;  // of the plate: nearer to the ends of the path nothing is cut, and there need be no side

/// `across` = N x T leads to the arc's middle: inside the circle is the right of a path that goes
/// counter-clockwise. A vertex next to the arc, farther from its ends than from the arc, is on the side of
/// its radius.
TEST_P(SidesOfArcs, AreThoseOfTheRadius) {
  const Arc& a = GetParam();
  const SurfaceMesh plate = grid(100, 100, -60, -60, edge);
  IncisionOptions options;
  options.reach = 0.8 * a.radius;
  const Incision incision(plate, arc(a.radius, a.begin, a.end), options);
  const auto& labels = incision.surroundings().labels();
  int compared = 0;
  for (std::size_t v = 0; v < labels.size(); ++v) {
    const Vec3 p = incision.mesh().position(static_cast<int>(v));
    const double radius = std::hypot(p.x, p.y), beside = radius - a.radius;
    double angle = std::atan2(p.y, p.x);
    while (angle < a.begin) angle += 2 * pi;
    const double s = a.radius * (angle - a.begin), length = a.radius * (a.end - a.begin);
    if (s < edge || s > length - edge || std::abs(beside) < 1e-6 || std::abs(beside) > 0.7 * a.radius)
      continue;
    ASSERT_TRUE(labels[v].reached) << p.x << " " << p.y;
    if (labels[v].side == Side::both) continue;  // reached from beyond an end, where places alone tell
    EXPECT_EQ(labels[v].side == Side::right, beside < 0) << p.x << " " << p.y;
    EXPECT_EQ(labels[v].detour, 0) << p.x << " " << p.y;
    ++compared;
  }
  EXPECT_GT(compared, 100);
}

INSTANTIATE_TEST_SUITE_P(OfARegularPlate, SidesOfArcs,
                         ::testing::Values(Arc{"from a vertex along an edge", 30, 0, pi / 2},
                                           Arc{"between vertices", 30.3, 0.1, 0.1 + pi / 2},
                                           Arc{"a closed loop", 12, 0, 2 * pi},
                                           Arc{"nearly a closed loop", 12, 0, 1.97 * pi},
                                           Arc{"a small closed loop", 4.8, 0, 2 * pi}),
                         [](const auto& one) {
                           std::string name = one.param.name;
                           std::replace(name.begin(), name.end(), ' ', '_');
                           return name;
                         });

}  // namespace
}  // namespace cleft
