#include "explorer/io/mesh_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "base/error.h"
#include "base/text.h"
#include "tests/incision/meshes.h"
#include "tests/support/expect_refusal.h"

namespace cleft {
namespace {

namespace fs = std::filesystem;
using testing::expect_refusal;

class MeshFile : public ::testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  void write(const std::string& name, const std::string& text) const { std::ofstream(path(name)) << text; }

 private:
  fs::path folder_ = fs::path(::testing::TempDir()) / ("cleft_mesh_file_" + std::to_string(getpid()));
};

TEST_F(MeshFile, ComesBackAsWritten) {
  const SurfaceMesh mesh = testing::sphere(2, 5);
  for (const char* name : {"a.vtp", "a.obj", "a.stl", "a.STL", "a.ply"}) {
    write_mesh(path(name), mesh, {{"s", 1, std::vector<double>(mesh.points.size(), 2)}});
    const SurfaceMesh back = read_mesh(path(name));
    ASSERT_EQ(back.points.size(), mesh.points.size()) << name;
    ASSERT_EQ(back.triangles.size(), mesh.triangles.size()) << name;
    EXPECT_EQ(testing::shape_of(CutMesh(back)).boundary_edges, 0)
        << name;                                                          // STL's loose corners are one again
    const double lost = name[2] == 's' || name[2] == 'S' ? 1e-3 : 1e-12;  // .stl has single precision
    EXPECT_NEAR(testing::shape_of(CutMesh(back)).volume, testing::shape_of(CutMesh(mesh)).volume, lost);
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(fs::path(path("x")).parent_path()), {}),
            5);  // nothing half-written
}

TEST_F(MeshFile, PolygonsBecomeTrianglesAndRubbishGoes) {
  write("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 9 9 9\nv 0.5 0 0\nf 1 2 3 4\nf 1 6 2\nf 1 1 2\n");
  const SurfaceMesh mesh = read_mesh(path("a.obj"));
  EXPECT_EQ(mesh.triangles.size(), 2u);  // the quadrangle; those without area are dropped
  EXPECT_EQ(mesh.points.size(), 4u);
}

TEST_F(MeshFile, ObjFacesMayNameOnlyWhatIsThere) {
  const std::string points = "v 0 0 0\nv 1 0 0\nv 1 1 0\n";
  for (const char* face :
       {"f 1/2 2/2 3/2", "f 1//1 2//1 3//1", "f 1 2 4", "f 1/1/1 2/1/1 3/1/1", "f 0 1 2", "f -4 1 2"}) {
    write("bad.obj", points + face + "\n");
    try {
      read_mesh(path("bad.obj"));
      ADD_FAILURE() << face;
    } catch (const FileError& error) {
      EXPECT_NE(std::string(error.what()).find("line 4"), std::string::npos) << error.what();
    }
  }
  write("good.obj", points + "vt 0 0\nvn 0 0 1\nf 1/1/1 2/1/1 3/1/1\n");
  EXPECT_EQ(read_mesh(path("good.obj")).triangles.size(), 1u);
}

/// A sphere 1e7 of its diameters from the origin, where numbers of single precision are as far apart as it is
/// wide.
SurfaceMesh far_sphere() {
  SurfaceMesh mesh = testing::sphere(2, 5);
  for (Vec3& p : mesh.points) p += {1e8, -7e7, 3e7};
  return mesh;
}

TEST_F(MeshFile, KeepsEveryPointFarFromTheOrigin) {
  const SurfaceMesh mesh = far_sphere();
  for (const char* name : {"far.vtp", "far.obj", "far.ply"}) {
    write_mesh(path(name), mesh);
    MeshReport report;
    const SurfaceMesh back = read_mesh(path(name), &report);
    EXPECT_EQ(report.merged_points, 0) << name;
    ASSERT_EQ(back.triangles.size(), mesh.triangles.size()) << name;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      for (int i = 0; i < 3; ++i)
        EXPECT_EQ(back.points[back.triangles[t][i]], mesh.points[mesh.triangles[t][i]]) << name;
  }
  std::string text = "solid far\n";
  for (const auto& t : mesh.triangles) {
    text += "facet normal 0 0 1\nouter loop\n";
    for (const int v : t)
      text += formatted("  vertex %.17g %.17g %.17g\n", mesh.points[v].x, mesh.points[v].y, mesh.points[v].z);
    text += "endloop\nendfacet\n";
  }
  write("far.stl", text + "endsolid far\n");
  EXPECT_EQ(read_mesh(path("far.stl")).points.size(), mesh.points.size());
}

TEST_F(MeshFile, OfSinglePrecisionIsNotWrittenFarFromTheOrigin) {
  expect_refusal("far sphere", [&] { write_mesh(path("far.stl"), far_sphere()); },
                 {"far.stl", "single precision", ".ply"});
  EXPECT_FALSE(fs::exists(path("far.stl")));
  SurfaceMesh near = testing::sphere(2, 5);
  const auto last = static_cast<int>(near.points.size());
  near.points.push_back(near.points[0] + Vec3{1e-12, 0, 0}), near.triangles.push_back({0, last, 1});
  write_mesh(path("near.stl"), near);
  EXPECT_EQ(read_mesh(path("near.stl")).triangles.size() + 1, near.triangles.size())
      << "a triangle of no size";
}

TEST_F(MeshFile, ObjLinesGoOnBehindABackslashAndFacesMayCountBack) {
  write("a.obj",
        "# a comment\r\nv 0 0 \\\r\n0\r\nv +1 0 0 0.5 0.5 0.5\nvn 0 0 1\nv 1 1e0 0\nf -3//1 -2//1 \\\n -1//1 "
        "# x\n"
        "l 1 2\nv 0 1 0\nf 1 3 4\nf 3 2 5\nv 2 1 0");
  const SurfaceMesh mesh = read_mesh(path("a.obj"));
  EXPECT_EQ(mesh.triangles.size(), 3u) << "the last names a point that comes after it";
  EXPECT_EQ(mesh.points.size(), 5u);
}

TEST_F(MeshFile, SaysWhichLineOfATextIsWrong) {
  const auto refused = [&](const std::string& name, const std::string& text,
                           const std::vector<std::string>& words) {
    write(name, text);
    expect_refusal(
        text, [&] { read_mesh(path(name)); }, words);
  };
  const std::string points = "v 0 0 0\nv 1 0 0\nv 1 1 0\n";
  refused("a.obj", "v 0 0 0\nv 1 0\n", {"line 2", "2 numbers"});
  refused("a.obj", "v 0 0 0\nv 1 x 0\n", {"line 2", "'x'"});
  refused("a.obj", "v 0 nan 0\n", {"line 1", "'nan'"});
  refused("a.obj", points + "f 1 2\n", {"line 4", "three corners"});
  for (const char* corner : {"/1", "1/x", "1/1/1/1", "x", "1.5", "99999999999999999999"})
    refused("a.obj", points + "vt 0 0\nvn 0 0 1\nf 2 3 " + std::string(corner) + "\n", {"line 6", corner});
  const std::string begin = "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n";
  refused("a.stl", begin + "vertex 1 y 0\nendloop\nendfacet\nendsolid\n", {"line 6", "'y'"});
  refused("a.stl", begin + "vertex 1 0\nendloop\nendfacet\nendsolid\n", {"line 6", "three numbers"});
  refused("a.stl", begin + "endloop\nendfacet\nendsolid\n", {"line 6", "three corners"});
  refused("a.stl", begin + "vertex 1 1 0\nendloop\nendfacet\n", {"endsolid"});
  refused("a.stl", "solid a\nfacet normal 0 0 1\nvertex 0 0 0\nendsolid\n", {"line 3", "loop"});
}

TEST_F(MeshFile, TruncatedFilesDoNotCrash) {
  const SurfaceMesh mesh = testing::sphere(2, 5);
  for (const char* ending : {".stl", ".obj", ".ply", ".vtp"}) {
    write_mesh(path(std::string("whole") + ending), mesh);
    const auto size = fs::file_size(path(std::string("whole") + ending));
    for (int k = 1; k < 8; ++k) {
      fs::copy_file(path(std::string("whole") + ending), path(std::string("part") + ending),
                    fs::copy_options::overwrite_existing);
      fs::resize_file(path(std::string("part") + ending), size * k / 8);
      try {
        EXPECT_LE(read_mesh(path(std::string("part") + ending)).triangles.size(), mesh.triangles.size());
      } catch (const FileError&) {
      }
    }
  }
}

TEST_F(MeshFile, ReadsPly) {
  write("a.ply",
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
        "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 "
        "1 2 3\n");
  EXPECT_EQ(read_mesh(path("a.ply")).triangles.size(), 2u);
}

TEST_F(MeshFile, SaysWhatIsWrong) {
  for (const char* ending : {".stl", ".obj", ".ply", ".vtp"}) {
    EXPECT_THROW(read_mesh(path(std::string("missing") + ending)), FileError) << ending;
    for (const char* text :
         {"", "nonsense", "<VTKFile type='PolyData'>\n", "ply\nformat ascii 1.0\nelement vertex 9\n",
          "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float "
          "z\nend_header\n1 2 3\n"}) {
      write(std::string("bad") + ending, text);
      EXPECT_THROW(read_mesh(path(std::string("bad") + ending)), FileError) << ending << ": " << text;
    }
  }
  try {
    read_mesh(path("mesh.3ds"));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find(".stl .obj .ply .vtp"), std::string::npos);
  }
  EXPECT_THROW(write_mesh(path("mesh.3ds"), testing::sphere(1, 1)), InputError);
  EXPECT_THROW(write_mesh(path("nowhere/mesh.stl"), testing::sphere(1, 1)), InputError);
}

}  // namespace
}  // namespace cleft
