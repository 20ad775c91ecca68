#include "solver/patch_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "tests/solver/small_patch.h"

namespace cleft {

namespace {

double volume(const PatchMesh& mesh, const std::array<int, 6>& w) {
  const auto p = [&](int i) { return mesh.points[w[i]]; };
  const auto tetrahedron = [](Vec3 a, Vec3 b, Vec3 c, Vec3 d) { return dot(b - a, cross(c - a, d - a)) / 6; };
  return tetrahedron(p(0), p(1), p(2), p(5)) + tetrahedron(p(0), p(1), p(5), p(4)) +
         tetrahedron(p(0), p(4), p(5), p(3));
}

Parameters awkward_patch() {  // nothing is a multiple of the element size
  Parameters p;
  p.patch.length = 31.3, p.patch.width = 17.1, p.patch.height = 7.7;
  p.cut.length = 12.9, p.cut.depth = 3.1;
  p.mesh.element_size = 0.93;
  return p;
}

}  // namespace

TEST(PatchMesh, FillsTheBoxWithWedgesAndCoversItsFaces) {
  for (const Parameters& p : {small_patch(), awkward_patch()}) {
    const PatchMesh mesh = make_patch_mesh(p);
    double sum = 0, top = 0, bottom = 0, sides = 0;
    for (const auto& w : mesh.wedges) {
      EXPECT_GT(volume(mesh, w), 0);
      sum += volume(mesh, w);
    }
    const auto area = [&](const auto& f) {
      return norm(cross(mesh.points[f[1]] - mesh.points[f[0]], mesh.points[f[2]] - mesh.points[f[0]]));
    };
    for (const auto& t : mesh.skin) top += area(t) / 2;
    for (const auto& t : mesh.bottom) bottom += area(t) / 2;
    for (const auto& q : mesh.sides) sides += area(q);
    const auto& b = p.patch;
    EXPECT_NEAR(sum, b.length * b.width * b.height, 1e-9);
    EXPECT_NEAR(top, b.length * b.width, 1e-9);
    EXPECT_NEAR(bottom, b.length * b.width, 1e-9);
    EXPECT_NEAR(sides, 2 * (b.length + b.width) * b.height, 1e-9);
  }
}

TEST(PatchMesh, TheCutIsFittedAndOpensInOrder) {
  for (Parameters p : {small_patch(), awkward_patch()})
    for (const char* frames : {"column", "pair"}) {
      p.cut.frames = frames;
      const PatchMesh mesh = make_patch_mesh(p);
      ASSERT_FALSE(mesh.pairs.empty());
      for (const auto& [left, right] : mesh.pairs) {
        EXPECT_EQ(mesh.points[left], mesh.points[right]);
        EXPECT_EQ(mesh.points[left].y, 0);
        EXPECT_LT(std::abs(mesh.points[left].x), p.cut.length / 2);
        EXPECT_GT(mesh.points[left].z, -p.cut.depth);
      }
      // The cut's rim is a line of nodes.
      const auto has = [&](double u, double w) {
        return std::any_of(mesh.points.begin(), mesh.points.end(),
                           [=](const Vec3& q) { return q.x == u && q.y == 0 && q.z == w; });
      };
      EXPECT_TRUE(has(-p.cut.length / 2, 0) && has(p.cut.length / 2, 0) &&
                  has(-p.cut.length / 2, -p.cut.depth));
      EXPECT_EQ(mesh.released.front(), 0);
      EXPECT_EQ(mesh.released.back(), static_cast<int>(mesh.pairs.size()));
      EXPECT_EQ(mesh.position.front(), -p.cut.length / 2);
      EXPECT_EQ(mesh.position.back(), p.cut.length / 2);
      EXPECT_TRUE(std::is_sorted(mesh.released.begin(), mesh.released.end(), std::less_equal<>()));
      EXPECT_TRUE(std::is_sorted(mesh.position.begin(), mesh.position.end(), std::less_equal<>()))
          << "positions must strictly increase";
      for (std::size_t j = 1; j < mesh.released.size(); ++j) {
        if (mesh.released[j] < static_cast<int>(mesh.pairs.size()) && p.cut.frames == "column") {
          EXPECT_EQ(mesh.points[mesh.pairs[mesh.released[j]][0]].x, mesh.position[j])
              << "the tip is the first column still closed";
        }
      }
    }
}

TEST(PatchMesh, TheSkinIsItsOwnMirrorImage) {
  const PatchMesh mesh = make_patch_mesh(small_patch());
  using Corners = std::set<std::pair<double, double>>;
  std::set<Corners> triangles, mirrored;
  for (const auto& t : mesh.skin) {
    Corners corners, mirror;
    for (const int n : t)
      corners.insert({mesh.points[n].x, mesh.points[n].y}),
          mirror.insert({mesh.points[n].x, -mesh.points[n].y});
    triangles.insert(corners), mirrored.insert(mirror);
  }
  EXPECT_EQ(triangles, mirrored);
}

TEST(PatchMesh, ElementsOfTheTwoSidesShareNoCutNode) {
  const PatchMesh mesh = make_patch_mesh(small_patch());
  for (const auto& w : mesh.wedges) {
    double side = 0;
    for (const int n : w) side += mesh.points[n].y;
    for (const auto& [left, right] : mesh.pairs)
      EXPECT_EQ(std::count(w.begin(), w.end(), side < 0 ? right : left), 0);
  }
}

}  // namespace cleft
