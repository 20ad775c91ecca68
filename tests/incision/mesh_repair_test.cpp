#include <gtest/gtest.h>

#include <filesystem>

#include "explorer/io/mesh_file.h"
#include "tests/incision/meshes.h"

namespace cleft {
namespace {

using namespace testing;

MeshReport report_of(const SurfaceMesh& mesh) {
  MeshReport report;
  repaired(mesh, report);
  return report;
}

TEST(MeshRepair, SoundMeshesStayAsTheyAre) {
  for (const SurfaceMesh& mesh :
       {sphere(2, 5), ring(12, 6, 5, 2, true), ring(12, 6, 5, 2, false), grid(4, 3, 0, 0, 1)}) {
    MeshReport report;
    const SurfaceMesh result = repaired(mesh, report);
    EXPECT_EQ(result.triangles, mesh.triangles);
    EXPECT_EQ(report.components, 1);
    EXPECT_EQ(report.turned_triangles + report.duplicate_triangles + report.non_manifold_edges, 0);
    EXPECT_EQ(report.non_manifold_vertices + report.inside_out_components, 0);
    EXPECT_EQ(report.boundary_edges, shape_of(CutMesh(mesh)).boundary_edges);
  }
}

TEST(MeshRepair, TurnsTheMinorityAndLeavesOutDuplicates) {
  const SurfaceMesh mesh = sphere(2, 5);
  SurfaceMesh bad = mesh;
  for (const std::size_t t : {3u, 17u, 18u, 90u}) std::swap(bad.triangles[t][0], bad.triangles[t][1]);
  bad.triangles.push_back({mesh.triangles[5][1], mesh.triangles[5][2], mesh.triangles[5][0]});
  bad.triangles.push_back({mesh.triangles[6][1], mesh.triangles[6][0], mesh.triangles[6][2]});
  MeshReport report;
  const SurfaceMesh result = repaired(bad, report);
  EXPECT_EQ(report.turned_triangles, 4);
  EXPECT_EQ(report.duplicate_triangles, 2);
  const Shape shape = shape_of(CutMesh(result));
  EXPECT_EQ(shape.bad_edges + shape.boundary_edges, 0);
  EXPECT_NEAR(shape.volume, shape_of(CutMesh(mesh)).volume, 1e-12);
}

TEST(MeshRepair, CountsWhatCannotBeMended) {
  SurfaceMesh bow_tie{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 0}, {-1, -1, 0}}, {{0, 1, 2}, {0, 3, 4}}};
  MeshReport report = report_of(bow_tie);
  EXPECT_EQ(report.non_manifold_vertices, 1);
  EXPECT_EQ(report.components, 1);
  EXPECT_EQ(report.boundary_edges, 6);
  SurfaceMesh inside_out = sphere(1, 1);
  for (auto& t : inside_out.triangles) std::swap(t[0], t[1]);
  report = report_of(inside_out);
  EXPECT_EQ(report.inside_out_components, 1);
  EXPECT_EQ(report.turned_triangles, 0);
}

TEST(MeshRepair, FindsWhatIsKnownOfDefectiveMeshes) {  // the counts that came with the meshes
  if (!std::filesystem::exists(CLEFT_SHARED_MESHES)) GTEST_SKIP() << CLEFT_SHARED_MESHES << " is absent";
  const auto read = [](const char* name) {
    MeshReport report;
    read_mesh(std::string(CLEFT_SHARED_MESHES "/defective/") + name, &report);
    return report;
  };
  EXPECT_EQ(read("two-boxes-shared-edge.stl").non_manifold_edges, 1);
  EXPECT_EQ(read("soup-100-loose.stl").components, 100);
  EXPECT_EQ(read("skull-and-teeth-34-components.obj").components, 34);
  EXPECT_EQ(read("liver-479-flipped.stl").duplicate_triangles, 3);
  EXPECT_EQ(read("dragon-non-manifold-dup-faces.obj").duplicate_triangles, 32);
  const MeshReport cracked = read("liver-26-components-cracked.stl");
  EXPECT_EQ(cracked.components, 26);
  EXPECT_EQ(cracked.boundary_edges, 182);
  EXPECT_EQ(cracked.non_manifold_vertices, 18);
}

}  // namespace
}  // namespace cleft
