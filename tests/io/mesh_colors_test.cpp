// Colours of a mesh's own: from files, through cuts, into files. They are linear in space, so that each point
// of the skin that is written must have the colour of its place, within the rounding to bytes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "base/error.h"
#include "explorer/io/mesh_file.h"
#include "explorer/io/ply_file.h"
#include "tests/incision/meshes.h"
#include "tests/pipeline/commands.h"
#include "tests/support/temporary_folder.h"

namespace cleft {
namespace {

PointColor color_there(const Vec3& p) {
  return {static_cast<float>(0.5 + 0.03 * p.x), static_cast<float>(0.5 - 0.02 * p.y),
          static_cast<float>(0.4 + 0.01 * (p.x + p.y))};
}

/// 20 x 20 squares of 1 under z = 0.
SurfaceMesh painted_plate() {
  SurfaceMesh mesh = testing::grid(20, 20, -10, -10, 1);
  for (const Vec3& p : mesh.points) mesh.colors.push_back(color_there(p));
  return mesh;
}

/// As text, by the test's own hand; `type` of the colours, `whole` their largest value, and what else a
/// vertex has.
std::string ply_text(const SurfaceMesh& mesh, const std::string& type, double whole, const std::string& first,
                     const std::string& alpha) {
  std::ostringstream out;
  out << "ply\nformat ascii 1.0\nelement vertex " << mesh.points.size() << "\nproperty " << type << ' '
      << first << "red\nproperty float x\nproperty float y\nproperty float z\nproperty " << type << ' '
      << first << "green\nproperty " << type << ' ' << first << "blue\n"
      << (alpha.empty() ? "" : "property uchar alpha\n") << "element face " << mesh.triangles.size()
      << "\nproperty list uchar int vertex_indices\nend_header\n";
  const auto part = [&](float value) { return whole == 1 ? value : std::round(whole * value); };
  for (std::size_t p = 0; p < mesh.points.size(); ++p)
    out << part(mesh.colors[p][0]) << ' ' << mesh.points[p].x << ' ' << mesh.points[p].y << ' '
        << mesh.points[p].z << ' ' << part(mesh.colors[p][1]) << ' ' << part(mesh.colors[p][2]) << ' '
        << alpha << '\n';
  for (const auto& t : mesh.triangles) out << "3 " << t[0] << ' ' << t[1] << ' ' << t[2] << '\n';
  return out.str();
}

/// How far the colours of a mesh are from those of their places, in its skin.
double off(const SurfaceMesh& mesh) {
  EXPECT_EQ(mesh.colors.size(), mesh.points.size());
  double most = mesh.colors.empty() ? HUGE_VAL : 0;
  for (std::size_t p = 0; p < mesh.colors.size(); ++p) {
    if (mesh.points[p].z < 0) continue;
    for (std::size_t k = 0; k < 3; ++k)
      most = std::max(most, double(std::abs(mesh.colors[p][k] - color_there(mesh.points[p])[k])));
  }
  return most;
}

constexpr double byte = 1 / 255.;

class MeshColors : public ::testing::Test {
 protected:
  Outcome cut(const std::string& mesh, const std::string& out) const {
    return run_cleft("cut", {"--mesh", mesh, "--path",
                             in.write("path.csv", "x,y,z,nx,ny,nz\n-4.2,0.73,0,0,0,1\n4.1,0.31,0,0,0,1\n"),
                             "--rest", "--depth", "2", "--out", out});
  }
  TemporaryFolder in;
};

TEST_F(MeshColors, OfPlyAreReadInEveryType) {
  const SurfaceMesh plate = painted_plate();
  for (const char* first : {"", "diffuse_"})
    for (const auto& [type, whole] :
         {std::pair{"uchar", 255.}, {"ushort", 65535.}, {"float", 1.}, {"double", 1.}}) {
      const std::string file = in.write("a.ply", ply_text(plate, type, whole, first, ""));
      // Text of six digits; of wholes half of one. The mesh has bytes.
      const MeshPolygons ply = read_ply(file);
      EXPECT_LT(off({ply.points, {}, ply.colors}), whole == 1 ? 2e-6 : 0.5 / whole + 2e-6) << type;
      EXPECT_LT(off(read_mesh(file)), 0.5 * byte + 0.5 / whole * (whole > 1) + 2e-6) << type;
    }
  EXPECT_LT(off(read_mesh(in.write("a.ply", ply_text(plate, "uchar", 255, "", "128")))), byte);
  EXPECT_TRUE(read_mesh(in.write("a.ply", ply_of(testing::grid(2, 2, 0, 0, 1)))).colors.empty());
}

TEST_F(MeshColors, ThatAreNoneAreRefused) {
  SurfaceMesh plate = painted_plate();
  const auto refusal = [&](const std::string& text) {
    try {
      read_mesh(in.write("bad.ply", text));
      return std::string();
    } catch (const FileError& e) {
      return std::string(e.what());
    }
  };
  EXPECT_NE(refusal(ply_text(plate, "int", 255, "", "")).find("'red' are of type int; uchar"),
            std::string::npos);
  plate.colors[7][1] = 1.5F;
  EXPECT_NE(refusal(ply_text(plate, "float", 1, "", "")).find("vertex 7 has the green 1.5; from 0 to 1"),
            std::string::npos);
  plate.colors[7][1] = -0.5F;
  EXPECT_NE(refusal(ply_text(plate, "float", 1, "", "")).find("vertex 7"), std::string::npos);
}

TEST_F(MeshColors, ComeBackAsWrittenToTheByte) {
  const SurfaceMesh plate = painted_plate();
  for (const char* name : {"a.ply", "a.vtp"}) {
    write_mesh(in / name, plate);
    const SurfaceMesh back = read_mesh(in / name);
    EXPECT_LE(off(back), byte / 2 + 1e-6) << name;
    write_mesh(in / name, back);
    EXPECT_EQ(read_mesh(in / name).colors, back.colors) << name;
    for (std::size_t p = 0; p < back.points.size(); ++p)
      EXPECT_NE(std::find(plate.points.begin(), plate.points.end(), back.points[p]), plate.points.end());
  }
}

TEST_F(MeshColors, SurviveTheCut) {
  write_mesh(in / "plate.ply", painted_plate());
  for (const char* name : {"cut.ply", "cut.vtp"}) {
    expect_success(cut(in / "plate.ply", in / name));
    const SurfaceMesh result = read_mesh(in / name);
    EXPECT_GT(result.points.size(), painted_plate().points.size() + 50);
    // Half a byte where it is read, and half where it is written.
    EXPECT_LE(off(result), byte + 1e-6) << name;
    int walls = 0;
    for (std::size_t p = 0; p < result.points.size(); ++p) {
      if (result.points[p].z > -1.99) continue;
      ++walls;
      EXPECT_NEAR(result.colors[p][0], 0.34, byte) << "muscle, at the bottom";
      EXPECT_NEAR(result.colors[p][1], 0.04, byte);
    }
    EXPECT_GT(walls, 10);
  }
}

TEST_F(MeshColors, AMeshWithoutThemGetsNone) {
  write_mesh(in / "plate.ply", testing::grid(20, 20, -10, -10, 1));
  for (const char* name : {"cut.ply", "cut.vtp"}) {
    expect_success(cut(in / "plate.ply", in / name));
    EXPECT_TRUE(read_mesh(in / name).colors.empty()) << name;
  }
}

}  // namespace
}  // namespace cleft
