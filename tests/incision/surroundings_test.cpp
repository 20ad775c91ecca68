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

/// How far the labels of the skin are from those around the same path if it is known before it is cut.
struct Apart {
  int sides = 0, reached = 0, compared = 0;
  double detour = 0;
};
Apart apart_from_known(const SurfaceMesh& mesh, const Incision& found) {
  const Incision known(mesh, found.path());
  const auto &a = known.surroundings().labels(), &b = found.surroundings().labels();
  Apart result;
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    const auto &one = known.mesh().vertices()[v], &other = found.mesh().vertices()[v];
    if (other.kind != VertexKind::skin || one.position != other.position) continue;
    const double beside = found.path().coordinates(one.position).v;
    const auto side = [&](const Surroundings::Label& label) {  // both: its place tells it
      return label.side != Side::both ? label.side : beside < 0 ? Side::left : Side::right;
    };
    if (std::abs(beside) < 1e-9) continue;  // of either side
    ++result.compared;
    result.reached += a[v].reached != b[v].reached;
    if (!a[v].reached || !b[v].reached) continue;
    result.sides += side(a[v]) != side(b[v]);
    result.detour = std::max(result.detour, std::abs(a[v].detour - b[v].detour));
  }
  return result;
}

double ridges(double x, double y) { return 4 * std::exp(-std::pow((y - 9 - 0.2 * x) / 1.5, 2)); }

/// While the blade goes the skin is searched piece by piece, beside a path that goes on straight; when it has
/// left, the whole of it again.
TEST(Surroundings, OfAPathThatWasFoundAreThoseOfOneThatWasKnown) {
  const SurfaceMesh mesh = grid(90, 70, -45, -35, 1, ridges);
  const auto place = [](double s) {
    const double y = 3 * std::sin(0.15 * s) + 0.03 * std::sin(9 * s);  // a bend of 15 mm, and a tremor
    return ScalpelPath::Point{{s - 20, y, ridges(s - 20, y)}, {0, 0, 1}, 3};
  };
  IncisionOptions options;
  options.refined = 0.7;
  ScalpelPath::Point straight = place(0.7);
  straight.position = place(0).position + 36 * normalized(straight.position - place(0).position);
  Incision cut(mesh, ScalpelPath({place(0), straight}), options);
  for (double s = 0.7; s < 40; s += 0.7) cut.extend(place(s), 18);
  const ScalpelPath whole = cut.path();
  cut.end_path();
  EXPECT_EQ(cut.extended_to(), 0);
  EXPECT_LT(cut.path().length(), whole.length() - 10);
  EXPECT_FALSE(cut.is_short_of_end());
  cut.search_again();
  const Apart apart = apart_from_known(mesh, cut);
  EXPECT_GT(apart.compared, 6000);
  EXPECT_EQ(apart.reached, 0);
  EXPECT_EQ(apart.sides, 0);
  EXPECT_LT(apart.detour, 0.3);  // beside the path the two meshes differ
}

}  // namespace
}  // namespace cleft
