// What is carried to the vertices of a cut mesh. Barycentric weights reproduce values that are linear in
// space, so that every vertex of the skin must have the value of such a function at its own place, however
// it was made or moved.
#include "explorer/incision/places_before.h"

#include <gtest/gtest.h>

#include "explorer/incision/cut_surface.h"
#include "explorer/incision/mesh_repair.h"
#include "tests/incision/meshes.h"

namespace cleft {
namespace {

using namespace testing;

PointColor linear_color(const Vec3& p) {
  return {static_cast<float>(0.5 + 0.02 * p.x - 0.01 * p.z), static_cast<float>(0.4 - 0.03 * p.y),
          static_cast<float>(0.3 + 0.01 * (p.x + p.y + p.z))};
}

SurfaceMesh colored(SurfaceMesh mesh) {
  for (const Vec3& p : mesh.points) mesh.colors.push_back(linear_color(p));
  return mesh;
}

Vec3 radial(const Vec3& p) { return p; }

/// Over the top of a sphere of radius 10; two cuts that cross.
std::vector<ScalpelPath> crossing_paths() {
  std::vector<ScalpelPath> paths;
  for (const auto& [x, y] : {std::pair{4., 0.9}, {-0.7, 4.}}) {
    std::vector<Vec3> points;
    for (const double at : {-1., -0.4, 0.3, 1.}) {
      const double px = at * x, py = at * y;
      points.push_back({px, py, std::sqrt(100 - px * px - py * py)});
    }
    paths.push_back(path_through(points, radial, 2));
  }
  return paths;
}

/// How far the colour of any vertex of the skin is from that of its place.
float worst(const CutMesh& mesh, const std::vector<PointColor>& colors) {
  float most = 0;
  for (std::size_t v = 0; v < colors.size(); ++v) {
    if (mesh.vertices()[v].depth > 0) continue;
    const PointColor expected = linear_color(mesh.vertices()[v].position);
    for (std::size_t k = 0; k < 3; ++k) most = std::max(most, std::abs(colors[v][k] - expected[k]));
  }
  return most;
}

TEST(PlacesBefore, CarryLinearColorsToEveryVertexOfTheSkin) {
  for (const SurfaceMesh& plain : {sphere(4, 10), sphere(3, 10)}) {
    const SurfaceMesh mesh = colored(plain);
    const CutSurface cut(mesh, crossing_paths());
    ASSERT_EQ(cut.colors().size(), cut.mesh().vertices().size());
    int lips = 0;
    for (const CutMesh::Vertex& v : cut.mesh().vertices())
      lips += v.kind == VertexKind::left_lip || v.kind == VertexKind::right_lip;
    EXPECT_GT(lips, 40);
    // Repaired slivers bend the surface by a tenth of the chord tolerance, 8e-3 / 10 here; the colours' slope
    // is 0.03 a unit at most.
    EXPECT_LT(worst(cut.mesh(), cut.colors()), 1e-4F);
  }
}

TEST(PlacesBefore, AVertexThatIsMovedOntoThePathGetsTheColorOfItsNewPlace) {
  const SurfaceMesh mesh = colored(grid(20, 20, -10, -10, 1));
  CutMesh cut_mesh(mesh);
  IncisionOptions unrefined;
  unrefined.max_edge = 0;
  Incision cut(cut_mesh, path_through({{-5.1, 0.08, 0}, {5.2, 0.06, 0}}, up, 3), unrefined);
  cut.advance_to(cut.path().length());
  int moved = 0;
  for (std::size_t p = 0; p < mesh.points.size(); ++p)
    moved += !(cut_mesh.vertices()[p].position == mesh.points[p]);
  ASSERT_GT(moved, 5) << "of the points there were: by about 0.07, over which a colour changes by 2e-3";
  EXPECT_LT(worst(cut_mesh, PlacesBefore(mesh).carried(cut_mesh, mesh.colors)), 1e-6F);
}

TEST(PlacesBefore, LipsAreAlikeOnBothSidesAndUntouchedPointsKeepTheirOwnToTheBit) {
  const SurfaceMesh mesh = colored(sphere(4, 10));
  const CutSurface cut(mesh, crossing_paths());
  for (const auto& one : cut.cuts())
    for (const auto& place : one->chain()) {
      const auto at = [&](int v) { return cut.colors()[static_cast<std::size_t>(v)]; };
      EXPECT_EQ(at(place.left), at(place.right));
    }
  std::size_t same = 0;
  for (std::size_t p = 0; p < mesh.points.size(); ++p)
    if (cut.mesh().vertices()[p].position == mesh.points[p]) {
      EXPECT_EQ(cut.colors()[p], mesh.colors[p]);
      ++same;
    }
  EXPECT_GT(same, mesh.points.size() * 9 / 10);
}

TEST(PlacesBefore, BelowTheSkinAreTheOnesOfTheSkinAbove) {
  const SurfaceMesh mesh = colored(grid(20, 20, -10, -10, 1));
  const CutSurface cut(mesh, {path_through({{-5.1, 0.33, 0}, {5.2, 0.71, 0}}, up, 3)});
  int below = 0;
  for (std::size_t v = 0; v < cut.colors().size(); ++v) {
    const CutMesh::Vertex& vertex = cut.mesh().vertices()[v];
    if (!(vertex.depth > 0)) continue;
    ++below;
    const PointColor above = linear_color({vertex.position.x, vertex.position.y, 0});
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(cut.colors()[v][k], above[k], 1e-5);
  }
  EXPECT_GT(below, 50);
}

TEST(PlacesBefore, FollowACutStepByStepAsAllAtOnce) {
  const SurfaceMesh mesh = colored(sphere(4, 10));
  CutMesh growing(mesh);
  PlacesBefore places(mesh);
  const ScalpelPath path = crossing_paths().front();
  Incision cut(growing, path);
  for (int i = 0; i <= 23; ++i) {  // stops leave vertices that are taken back
    cut.advance_to(path.length() * i / 23);
    EXPECT_LT(worst(growing, places.carried(growing, mesh.colors)), 1e-4F) << i;
  }
  const auto stepwise = places.carried(growing, mesh.colors);
  const auto at_once = PlacesBefore(mesh).carried(growing, mesh.colors);
  for (std::size_t v = 0; v < at_once.size(); ++v)
    if (growing.vertices()[v].depth == 0)
      for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(stepwise[v][k], at_once[v][k], 1e-6);
  cut.undo();
  EXPECT_EQ(places.carried(growing, mesh.colors).size(), mesh.points.size());
  EXPECT_EQ(places.carried(growing, mesh.colors), mesh.colors);
}

TEST(PlacesBefore, TheTwoSkinsOfAThinSheetStayApart) {
  // Two layers, 0.01 apart: white above, black below.
  SurfaceMesh sheet = grid(20, 20, -10, -10, 1);
  const std::size_t above = sheet.points.size();
  const SurfaceMesh lower = grid(20, 20, -10, -10, 1);
  for (Vec3 p : lower.points) sheet.points.push_back({p.x, p.y, -0.01});
  for (auto [a, b, c] : lower.triangles) {
    const int by = static_cast<int>(above);
    sheet.triangles.push_back({b + by, a + by, c + by});
  }
  for (std::size_t p = 0; p < sheet.points.size(); ++p)
    sheet.colors.push_back(p < above ? PointColor{1, 1, 1} : PointColor{0, 0, 0});
  const CutSurface cut(sheet, {path_through({{-5.1, 0.33, 0}, {5.2, 0.71, 0}}, up, 0.005)});
  int in_upper = 0, in_lower = 0;
  for (std::size_t v = sheet.points.size(); v < cut.colors().size(); ++v) {
    const CutMesh::Vertex& vertex = cut.mesh().vertices()[v];
    const bool is_lower = vertex.position.z == -0.01;  // refined there too
    ++(is_lower ? in_lower : in_upper);
    EXPECT_EQ(cut.colors()[v][0], is_lower ? 0 : 1) << place_of(vertex.position);
  }
  EXPECT_GT(in_upper, 50);
  EXPECT_GT(in_lower, 5);
}

TEST(PlacesBefore, RepairsKeepColors) {
  SurfaceMesh mesh = colored(sphere(2, 5));
  mesh.triangles.push_back(mesh.triangles.front());
  MeshReport report;
  const SurfaceMesh result = repaired(mesh, report);
  EXPECT_EQ(report.duplicate_triangles, 1);
  EXPECT_EQ(result.colors, mesh.colors);
  EXPECT_TRUE(CutSurface(sphere(2, 5), {}).colors().empty());
}

}  // namespace
}  // namespace cleft
