#include "explorer/io/mesh_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "base/error.h"
#include "tests/incision/meshes.h"

namespace cleft {
namespace {

namespace fs = std::filesystem;

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
        << name;  // STL's loose corners are one again
    // .stl has floats and .obj six digits.
    EXPECT_NEAR(testing::shape_of(CutMesh(back)).volume, testing::shape_of(CutMesh(mesh)).volume, 1e-3);
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
