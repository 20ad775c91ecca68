#include <gtest/gtest.h>

#include "base/error.h"
#include "explorer/incision/refine.h"
#include "tests/incision/meshes.h"

namespace cleft {
namespace {

using namespace testing;

TEST(CutMesh, SplitsKeepAdjacency) {
  for (const SurfaceMesh& surface : {grid(4, 3, 0, 0, 1), sphere(2, 5), ring(12, 6, 5, 2, true)}) {
    CutMesh mesh(surface);
    ASSERT_TRUE(adjacency_holds(mesh));
    const Shape before = shape_of(mesh);
    for (int t = 0; t < 20; ++t) {
      const auto v = mesh.triangle(t).vertex;
      mesh.split_edge(t, t % 3, 0.5 * (mesh.position(v[t % 3]) + mesh.position(v[(t + 1) % 3])));
      const auto w = mesh.triangle(t).vertex;
      mesh.split_face(t, 1. / 3 * (mesh.position(w[0]) + mesh.position(w[1]) + mesh.position(w[2])));
    }
    ASSERT_TRUE(adjacency_holds(mesh));
    const Shape after = shape_of(mesh);
    EXPECT_EQ(after.euler, before.euler);
    EXPECT_EQ(after.bad_edges + after.split_vertices, 0);
    EXPECT_NEAR(after.skin_area, before.skin_area, 1e-12 * before.skin_area);
  }
}

TEST(CutMesh, RollsBackToTheMark) {
  CutMesh mesh(sphere(2, 5));
  const CutMesh untouched = mesh;
  const CutMesh::Checkpoint mark = mesh.checkpoint();
  mesh.split_edge(3, 1, {1, 2, 3});
  mesh.split_face(5, {3, 2, 1});
  mesh.edit_vertex(2).position = {9, 9, 9};
  mesh.roll_back(mark);
  ASSERT_EQ(mesh.triangles().size(), untouched.triangles().size());
  ASSERT_EQ(mesh.vertices().size(), untouched.vertices().size());
  EXPECT_EQ(mesh.position(2), untouched.position(2));
  EXPECT_TRUE(adjacency_holds(mesh));
}

TEST(CutMesh, NoStepCarriesTheMeshToAnotherPlace) {
  CutMesh mesh(grid(20, 20, -10, -10, 1));
  const auto places = [&mesh] {
    return std::array<const void*, 3>{mesh.triangles().data(), mesh.vertices().data(), mesh.sheets().data()};
  };
  for (int k = 0; k < 3; ++k) {
    IncisionOptions options;
    options.max_edge = 0.3, options.reach = 0;
    const std::size_t before = mesh.triangles().size();
    Incision cut(mesh, path_through({{-8, 2 * k - 3.3, 0}, {8, 2 * k - 2.8, 0}}, up, 3), options);
    const auto begun = places();
    cut.advance_to(cut.path().length());
    EXPECT_EQ(places(), begun);
    EXPECT_GT(mesh.triangles().size(), before + 800);
  }
}

TEST(CutMesh, FansOfBowTiesAndThreefoldEdgesAreReported) {
  SurfaceMesh bow_tie{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 0}, {-1, -1, 0}}, {{0, 1, 2}, {0, 3, 4}}};
  EXPECT_THROW(CutMesh(bow_tie).skin_fan(0), InputError);
  EXPECT_NO_THROW(CutMesh(bow_tie).skin_fan(1));
  SurfaceMesh threefold{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}},
                        {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}};
  EXPECT_THROW(CutMesh(threefold).skin_fan(0), InputError);
  EXPECT_THROW(CutMesh(SurfaceMesh{{{0, 0, 0}}, {{0, 1, 2}}}), InputError);
}

TEST(Refine, MakesShortEdgesNearThePathAndKeepsTheSurface) {
  for (const SurfaceMesh& surface : {grid(10, 10, -10, -10, 2), sphere(3, 10)}) {
    CutMesh mesh(surface);
    const Shape before = shape_of(mesh);
    const Vec3 top = surface.points.size() == 121 ? Vec3{0, 0, 0} : Vec3{0, 0, 10};
    const ScalpelPath path = path_through({top + Vec3{-2, 0.3, 0}, top + Vec3{2, -0.2, 0}}, up, 1);
    refine_along(mesh, path, {0, 0.25, 0.5, false});
    const Shape after = shape_of(mesh);
    EXPECT_TRUE(adjacency_holds(mesh));
    EXPECT_EQ(after.euler, before.euler);
    EXPECT_EQ(after.boundary_edges >= before.boundary_edges, true);
    EXPECT_NEAR(after.skin_area, before.skin_area, 1e-12 * before.skin_area);
    EXPECT_NEAR(after.volume, before.volume, 1e-12 * before.skin_area);
    EXPECT_GE(after.smallest_angle, before.smallest_angle / 2);  // Rosenberg and Stenger 1975
    EXPECT_GT(mesh.triangles().size(), surface.triangles.size());
    for (const auto& t : mesh.triangles())
      for (int i = 0; i < 3; ++i) {
        const Vec3 a = mesh.position(t.vertex[i]), b = mesh.position(t.vertex[(i + 1) % 3]);
        const PathCoordinates c = path.coordinates(0.5 * (a + b));
        if (c.s > 0 && c.s < path.length() && std::abs(c.v) < 0.1 && std::abs(c.w) < 0.3) {
          EXPECT_LE(norm(a - b), 0.25);
        }
      }
  }
}

TEST(Refine, StopsAtEdgesThatAreNotManifold) {
  SurfaceMesh threefold{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}},
                        {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}};
  CutMesh mesh(threefold);
  refine_along(mesh, path_through({{0.1, 0.1, 0}, {0.4, 0.3, 0}}, up, 1), {0, 0.1, 0.2, false});
  for (const auto& v : mesh.vertices()) EXPECT_TRUE(std::isfinite(v.position.x));
}

}  // namespace
}  // namespace cleft
