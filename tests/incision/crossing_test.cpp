// Cuts that meet cuts, and taking cuts back.
#include <gtest/gtest.h>

#include <set>

#include "base/error.h"
#include "explorer/incision/triangle_quality.h"
#include "tests/incision/meshes.h"

namespace cleft {
namespace {

using namespace testing;

constexpr double pi = std::numbers::pi;

Vec3 radial(const Vec3& p) { return p; }

IncisionOptions unrefined() {
  IncisionOptions options;
  options.max_edge = 0;
  return options;
}

/// On a sphere of radius 10 above its top, through places given by x and y.
ScalpelPath on_top(const std::vector<std::array<double, 2>>& places, double depth) {
  std::vector<Vec3> points;
  for (const auto& [x, y] : places) points.push_back({x, y, std::sqrt(100 - x * x - y * y)});
  return path_through(points, radial, depth);
}

/// A slit opens a closed surface into itself: whatever slits, of whatever depth, it stays a closed sphere.
void expect_sphere(const CutMesh& mesh) {
  const Shape shape = shape_of(mesh);
  EXPECT_EQ(shape.euler, 2);
  EXPECT_EQ(shape.boundary_edges, 0);
  EXPECT_EQ(shape.bad_edges, 0);
  EXPECT_EQ(shape.split_vertices, 0);
  EXPECT_TRUE(adjacency_holds(mesh));
}

/// The skin's pieces: how many parts remain connected over skin alone.
int skin_pieces(const CutMesh& mesh) {
  std::vector<bool> seen(mesh.triangles().size());
  int pieces = 0;
  for (std::size_t first = 0; first < seen.size(); ++first) {
    if (seen[first] || mesh.triangles()[first].region != Region::skin) continue;
    ++pieces;
    std::vector<int> work{static_cast<int>(first)};
    seen[first] = true;
    while (!work.empty()) {
      const int t = work.back();
      work.pop_back();
      for (const int n : mesh.triangle(t).neighbor)
        if (n >= 0 && !seen[n] && mesh.triangle(n).region == Region::skin) seen[n] = true, work.push_back(n);
    }
  }
  return pieces;
}

int crossings(const Incision& cut) {
  int count = 0;
  for (std::size_t i = 1; i < cut.chain().size(); ++i) count += cut.chain()[i].s == cut.chain()[i - 1].s;
  return count;
}

class Depths : public ::testing::TestWithParam<double> {};  // of the second cut; the first is 2 deep

TEST_P(Depths, CrossingAnotherCut) {
  CutMesh mesh(sphere(4, 10));
  Incision first(mesh, on_top({{-4, 0.1}, {0, 0.3}, {4, 0.2}}, 2), unrefined());
  first.advance_to(100);
  Incision second(mesh, on_top({{0.3, -4}, {0.1, 0}, {0.2, 4}}, GetParam()), unrefined());
  second.advance_to(100);
  expect_sphere(mesh);
  EXPECT_EQ(crossings(second), 1);
  EXPECT_EQ(skin_pieces(mesh), 1);
  EXPECT_NEAR(second.tip(), second.path().length(), 1e-9);
  // On both sides of the second cut the first one's lips have a vertex where it crosses.
  std::set<int> there;
  for (std::size_t i = 1; i < second.chain().size(); ++i)
    if (second.chain()[i].s == second.chain()[i - 1].s)
      for (const auto& c : {second.chain()[i - 1], second.chain()[i]}) there.insert({c.left, c.right});
  EXPECT_EQ(there.size(), 4u);
}

/// A vertex that a crossing makes on both lips of an earlier cut knows where on its path it is.
TEST(Crossing, BothLipsKnowTheirPlaceOnThePath) {
  int compared = 0;
  for (int k = 0; k < 12; ++k) {
    CutMesh mesh(sphere(4, 10));
    Incision first(mesh, on_top({{-4, 0.1}, {0, 0.3}, {4, 0.2}}, 2), unrefined());
    first.advance_to(100);
    const double at = -3 + 0.5 * k;
    Incision second(mesh, on_top({{at - 1, -4}, {at, 0}, {at + 1, 4}}, 2), unrefined());
    second.advance_to(100);
    for (int v = 0; v < static_cast<int>(mesh.vertices().size()); ++v) {
      const CutMesh::Vertex& vertex = mesh.vertex(v);
      if (vertex.cut != 0 || (vertex.kind != VertexKind::left_lip && vertex.kind != VertexKind::right_lip))
        continue;
      EXPECT_NEAR(vertex.s, first.path().coordinates(vertex.position).s, 0.02) << at;
      ++compared;
    }
  }
  EXPECT_GT(compared, 100);
}

TEST(Crossing, APathThatBeginsBeforeALipOrTheOutlineDoesNotTurnBack) {
  for (const double start : {-9.97, 0.46}) {  // from there on along -y: over the outline, or into the wound
    CutMesh mesh(grid(20, 20, -10, -10, 1));
    Incision first(mesh, path_through({{-4, 0.43, 0}, {4, 0.44, 0}}, up, 2), unrefined());
    first.advance_to(100);
    Incision second(mesh, path_through({{0.3, start, 0}, {0.28, start - 3, 0}}, up, 2), unrefined());
    second.advance_to(100);
    EXPECT_GE(second.chain().size(), 2u);
    for (std::size_t i = 1; i < second.chain().size(); ++i)
      EXPECT_LE(mesh.position(second.chain()[i].left).y, mesh.position(second.chain()[i - 1].left).y)
          << start << ' ' << i;
  }
}

TEST_P(Depths, EndingInAnotherCut) {
  CutMesh mesh(sphere(4, 10));
  Incision first(mesh, on_top({{-4, 0.1}, {0, 0.3}, {4, 0.2}}, 2), unrefined());
  first.advance_to(100);
  // The path ends on the first one's line: the height of the first path at x = 0 is that of y = 0.3.
  Incision second(mesh, on_top({{0, -4}, {0, -2}, {0, 0.3}}, GetParam()), unrefined());
  second.advance_to(100);
  expect_sphere(mesh);
  EXPECT_EQ(skin_pieces(mesh), 1);
  EXPECT_NE(second.chain().back().left, second.chain().back().right);  // open into the first cut
}

TEST_P(Depths, CrossingThreeCutsAndItself) {
  CutMesh mesh(sphere(4, 10));
  std::vector<std::unique_ptr<Incision>> cuts;
  for (const double y : {-2., 0.1, 2.2}) {
    cuts.push_back(std::make_unique<Incision>(mesh, on_top({{-4, y}, {0, y + 0.2}, {4, y}}, 2), unrefined()));
    cuts.back()->advance_to(100);
  }
  std::vector<std::array<double, 2>> loop;  // up, a turn to the left, and back over its own line
  for (double y = -4; y < 3; y += 0.5) loop.push_back({0.3, y});
  for (double a = 0; a <= 1.5 * pi; a += 0.3) loop.push_back({-0.7 + std::cos(a), 3 + std::sin(a)});
  for (double x = -0.7; x < 3; x += 0.4) loop.push_back({x, 2.0});
  Incision last(mesh, on_top(loop, GetParam()), unrefined());
  last.advance_to(100);
  expect_sphere(mesh);
  EXPECT_GE(crossings(last), 4);
}

INSTANTIATE_TEST_SUITE_P(Crossing, Depths, ::testing::Values(0.7, 1.3, 2., 3.1));

TEST(Crossing, ALoopCutsAnIslandOut) {
  CutMesh mesh(sphere(4, 10));
  std::vector<std::array<double, 2>> loop;
  for (double a = 0; a <= 2.4 * pi; a += 0.2)
    loop.push_back({3 * (1 + 0.05 * a) * std::cos(a), 3 * std::sin(a)});
  for (int i = 0; i < 3; ++i) loop.push_back({loop.back()[0] - 1, loop.back()[1] - 0.3});
  Incision cut(mesh, on_top(loop, 1), unrefined());
  cut.advance_to(100);
  EXPECT_GE(crossings(cut), 1);
  EXPECT_EQ(skin_pieces(mesh), 1 + crossings(cut));
  expect_sphere(mesh);
}

TEST(Undo, TakesCutsBackAndMakesThemAgainBitForBit) {
  CutMesh mesh(sphere(4, 10));
  const auto state = [&mesh] { return state_of(mesh); };
  const auto untouched = state();
  Incision first(mesh, on_top({{-4, 0.1}, {0, 0.3}, {4, 0.2}}, 2));
  first.advance_to(3);
  first.advance_to(100);
  const auto one = state();
  Incision second(mesh, on_top({{0.3, -4}, {0.1, 0}, {0.2, 4}}, 3));
  second.advance_to(100);
  const auto two = state();
  second.undo();
  EXPECT_EQ(state(), one);
  second.redo();
  EXPECT_EQ(state(), two);
  second.undo();
  first.undo();
  EXPECT_EQ(state(), untouched);
  first.redo();
  second.redo();
  EXPECT_EQ(state(), two);
}

TEST(ChangedTriangles, AreAllThatChanged) {
  CutMesh mesh(sphere(4, 10));
  Incision cut(mesh, on_top({{-4, 0.1}, {0, 1.3}, {4, 0.2}}, 2), unrefined());
  const auto corners = [&mesh](std::size_t t) {
    std::vector<double> all;
    for (const int v : mesh.triangles()[t].vertex)
      for (int k = 0; k < 3; ++k) all.push_back(mesh.position(v)[k]);
    return all;
  };
  std::vector<std::vector<double>> known;
  for (std::size_t t = 0; t < mesh.triangles().size(); ++t) known.push_back(corners(t));
  for (double s = 0.3; s < 9; s += 0.3) {
    cut.advance_to(s);
    for (const int t : cut.changed_triangles()) {
      known.resize(std::max<std::size_t>(known.size(), static_cast<std::size_t>(t) + 1));
      known[t] = t < static_cast<int>(mesh.triangles().size()) ? corners(static_cast<std::size_t>(t))
                                                               : std::vector<double>{};
    }
    EXPECT_LT(cut.changed_triangles().size(), 400u);
    for (std::size_t t = 0; t < known.size(); ++t) {
      if (t < mesh.triangles().size()) {
        ASSERT_EQ(known[t], corners(t));
      } else {
        ASSERT_TRUE(known[t].empty());
      }
    }
  }
}

TEST(TriangleQuality, IsTheRatioOfTheRadii) {
  EXPECT_NEAR(radius_ratio({0, 0, 0}, {1, 0, 0}, {0.5, std::sqrt(0.75), 0}), 1, 1e-15);
  // Sides 3, 4, 5: inscribed 1, circumscribed 2.5.
  EXPECT_NEAR(radius_ratio({0, 0, 0}, {3, 0, 0}, {0, 4, 0}), 0.8, 1e-15);
  EXPECT_EQ(radius_ratio({0, 0, 0}, {1, 1, 1}, {2, 2, 2}), 0);
}

}  // namespace
}  // namespace cleft
