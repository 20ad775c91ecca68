// How long elements are, at the cut and away from it, and where their nodes stand.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "solver/patch_mesh.h"
#include "tests/solver/patch_mesh_shapes.h"

namespace cleft {

namespace {

/// Distinct values, up to rounding, of a coordinate of the nodes that a rule picks; sorted.
template <class Rule>
std::vector<double> lines_of(const PatchMesh& mesh, int axis, Rule rule) {
  std::vector<double> values, distinct;
  for (const Vec3& x : mesh.points)
    if (rule(x)) values.push_back(x[axis]);
  std::sort(values.begin(), values.end());
  for (const double value : values)
    if (distinct.empty() || value > distinct.back() + 1e-9) distinct.push_back(value);
  return distinct;
}

}  // namespace

TEST(PatchMesh, ElementsAtTheCutAreNoLongerThanTheElementSize) {
  for (const auto& [name, p] : shapes()) {
    SCOPED_TRACE(name);
    const PatchMesh mesh = make_patch_mesh(p);
    std::set<int> on_cut;
    for (const NodePair& pair : mesh.pairs) on_cut.insert({pair.left, pair.right});
    for (const auto& w : mesh.wedges)
      for (const int a : w)
        for (const int b : w) {
          if (!on_cut.count(a)) continue;
          const Vec3 d = mesh.points[b] - mesh.points[a];
          EXPECT_LE(std::abs(d.x), p.mesh.element_size + 1e-9);
          EXPECT_LE(std::abs(d.z), p.mesh.element_size + 1e-9);
          if (d.x == 0 && d.z == 0) {
            EXPECT_LE(std::abs(d.y), p.mesh.element_size + 1e-9);
          }
          if (on_cut.count(b) && d.z == 0) {
            EXPECT_LE(norm(d), p.mesh.element_size * std::sqrt(2) + 1e-9);
          }
        }
  }
}

/// The skin bends the thin edge of a lip over a tilted blade the more the thinner it is. Fronts are parts of
/// the elements at the bottom and the ends of the cut, which remain.
TEST(PatchMesh, LipsOverATiltedBladeHaveSmallElements) {
  Parameters p = awkward_patch();
  p.cut.count = 1, p.mesh.element_size = 0.9;
  const PatchMesh upright = make_patch_mesh(p);
  p.cut.tilt = 45;
  const PatchMesh tilted = make_patch_mesh(p);
  const auto beside = [](const PatchMesh& mesh) {
    double nearest = 1e9;
    for (const Vec3& x : mesh.points)
      if (x.z == 0 && std::abs(x.y) > 1e-9) nearest = std::min(nearest, std::abs(x.y));
    return nearest;
  };
  EXPECT_GT(beside(upright), 0.7 * p.mesh.element_size);
  EXPECT_LE(beside(tilted), p.mesh.element_size / 8 + 1e-9);
  const auto& depth = tilted.lines_depth;
  const auto layers = upright.lines_depth.size(), finer = depth.size();
  EXPECT_LE(depth[1], p.mesh.element_size / 8 + 1e-9);
  EXPECT_GT(finer, layers);
  EXPECT_EQ(depth[finer - 2], upright.lines_depth[layers - 2]);
  const auto& along = tilted.lines_along[0];
  EXPECT_LE(along[1] - along[0], std::sqrt(0.5) * p.mesh.element_size + 1e-9);
  EXPECT_LT(along[2] - along[1], upright.lines_along[0][2] - upright.lines_along[0][1]);
}

TEST(PatchMesh, ElementsGrowByTheGradingAwayFromTheCut) {
  Parameters p = awkward_patch();
  p.mesh.grading = 1.3;
  p.cut.count = 2, p.cut.spacing = 2.9;
  const PatchMesh mesh = make_patch_mesh(p);
  const auto all = [](const Vec3&) { return true; };
  const double h = p.mesh.element_size;
  const auto expect_graded = [&](std::vector<double> lines, double from, double to) {
    const auto at = [&](double place) {
      const auto found =
          std::find_if(lines.begin(), lines.end(), [=](double x) { return std::abs(x - place) < 1e-12; });
      EXPECT_NE(found, lines.end()) << place << " must be a line";
      return found - lines.begin();
    };
    const auto first = at(from), last = at(to);
    const int step = last > first ? 1 : -1;
    double nominal = h, fitting = 0, size_before = 0;
    for (auto i = first; i != last; i += step) {
      const double size = std::abs(lines[i + step] - lines[i]);
      EXPECT_LE(size, nominal + 1e-9);
      if (i != first) {
        EXPECT_NEAR(size / size_before, p.mesh.grading, 1e-9);
      }
      if (i + step != last) fitting += nominal;
      size_before = size;
      nominal *= p.mesh.grading;
    }
    EXPECT_LT(fitting, std::abs(to - from)) << "one element fewer would be too long";
  };
  const std::vector<double> u = lines_of(mesh, 0, all), v = lines_of(mesh, 1, all),
                            w = lines_of(mesh, 2, all);
  expect_graded(u, p.cut.length / 2, p.patch.length / 2);
  expect_graded(u, -p.cut.length / 2, -p.patch.length / 2);
  expect_graded(v, p.cut.spacing / 2, p.patch.width / 2);
  expect_graded(v, -p.cut.spacing / 2, -p.patch.width / 2);
  expect_graded(w, -p.cut.depth, -p.patch.height);
  EXPECT_EQ(
      std::count_if(v.begin(), v.end(), [&](double x) { return std::abs(x) < p.cut.spacing / 2 - 1e-9; }), 3)
      << "uniform between the cuts";
}

TEST(PatchMesh, TheMeshBesideAShapedCutIsThatOfTheBoxAtTheSides) {
  Parameters p = awkward_patch();
  const auto at_the_sides = [](const Parameters& q) {
    const auto rule = [&](const Vec3& x) { return std::abs(x.y) == q.patch.width / 2; };
    return lines_of(make_patch_mesh(q), 0, rule);
  };
  p.cut.tilt = 45;
  const std::vector<double> tilted = at_the_sides(p);
  p.cut.tilt = 0;
  Parameters shorter = p;  // as the elements along a tilted cut are
  shorter.mesh.element_size *= std::cos(45 * std::numbers::pi / 180);
  EXPECT_EQ(tilted, at_the_sides(shorter));
  p.cut.radius = 8;  // ends at u = 8 sin(12.9 / 16)
  const std::vector<double> arc = at_the_sides(p);
  EXPECT_TRUE(std::any_of(arc.begin(), arc.end(),
                          [](double u) { return std::abs(u - 8 * std::sin(12.9 / 16)) < 1e-12; }));
}

TEST(PatchMesh, NodesFarFromTheCutReturnToTheBoxOrStandUpright) {
  const auto skin_lines_at_end = [](const Parameters& p) {
    return lines_of(make_patch_mesh(p), 1,
                    [&](const Vec3& x) { return x.x == p.patch.length / 2 && x.z == 0; });
  };
  Parameters arc = small_patch();
  arc.cut.radius = 100;  // rises by 0.045 mm, so that as many lines fit as for a straight cut
  arc.patch.width = 5.8;
  const std::vector<double> of_arc = skin_lines_at_end(arc);
  arc.cut.radius = 0;
  EXPECT_EQ(of_arc, skin_lines_at_end(arc));

  Parameters tilted = awkward_patch();
  tilted.cut.tilt = 45;
  const PatchMesh mesh = make_patch_mesh(tilted);
  std::map<double, double> shift;  // of the first pair's column, by depth
  for (std::size_t n = 0; n < mesh.points.size(); ++n)
    if (mesh.skin_above[n] == mesh.pairs[0].left) shift[-mesh.points[n].z] = mesh.points[n].y;
  const double depth = tilted.cut.depth;
  for (const auto& [below, v] : shift) {  // slope 1, and from the bottom on a parabola to slope 0
    const double x = std::clamp(below - depth, 0.0, depth);
    EXPECT_NEAR(v, std::min(below, depth) + x - x * x / (2 * depth), 1e-12);
  }
  EXPECT_NEAR(shift.rbegin()->second, 1.5 * depth, 1e-12);
}

}  // namespace cleft
