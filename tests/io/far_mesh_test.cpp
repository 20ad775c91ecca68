// A mesh far from the origin is cut as the same mesh at the origin is, but for the rounding of coordinates.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "base/text.h"
#include "explorer/io/mesh_file.h"
#include "tests/incision/meshes.h"
#include "tests/pipeline/commands.h"
#include "tests/support/temporary_folder.h"

namespace cleft {
namespace {

constexpr double unit = 0x1p-27;  ///< of the last place of coordinates from 2^25 to 2^26

double rounded(double x) { return std::round(x / unit) * unit; }

std::string ply_of(const SurfaceMesh& mesh, const Vec3& by) {
  std::ostringstream out;
  out << "ply\nformat ascii 1.0\nelement vertex " << mesh.points.size()
      << "\nproperty double x\nproperty double y\nproperty double z\nelement face " << mesh.triangles.size()
      << "\nproperty list uchar int vertex_indices\nend_header\n";
  for (const Vec3& p : mesh.points)
    out << shortest(rounded(p.x) + by.x) << ' ' << shortest(rounded(p.y) + by.y) << ' '
        << shortest(rounded(p.z) + by.z) << '\n';
  for (const auto& t : mesh.triangles) out << "3 " << t[0] << ' ' << t[1] << ' ' << t[2] << '\n';
  return out.str();
}

std::string path_of(const std::vector<std::array<double, 2>>& places, const Vec3& by) {
  std::string text = "x,y,z,nx,ny,nz\n";
  for (const auto& [x, y] : places) {
    const Vec3 p{x, y, std::sqrt(100 - x * x - y * y)};
    text += shortest(rounded(p.x) + by.x) + "," + shortest(rounded(p.y) + by.y) + "," +
            shortest(rounded(p.z) + by.z) + "," + shortest(p.x) + "," + shortest(p.y) + "," + shortest(p.z) +
            "\n";
  }
  return text;
}

/// A curved way over the top of the sphere.
std::vector<std::array<double, 2>> some_places(std::mt19937& random) {
  std::uniform_real_distribution<double> around(-1, 1);
  double x = 3 * around(random), y = 3 * around(random), angle = 3 * around(random);
  std::vector<std::array<double, 2>> places;
  for (int i = 0; i < 6; ++i) {
    places.push_back({x, y});
    angle += 0.3 * around(random);
    x += std::cos(angle), y += std::sin(angle);
  }
  return places;
}

SurfaceMesh cut_of(const TemporaryFolder& in, const std::vector<std::vector<std::array<double, 2>>>& paths,
                   const Vec3& by) {
  std::vector<std::string> arguments{"--mesh",      in.write("mesh.ply", ply_of(testing::sphere(4, 10), by)),
                                     "--rest",      "--depth",
                                     "2",           "--max-edge",
                                     "0",           "--out",
                                     in / "cut.vtp"};
  for (std::size_t i = 0; i < paths.size(); ++i)
    arguments.insert(arguments.end(),
                     {"--path", in.write("path" + std::to_string(i) + ".csv", path_of(paths[i], by))});
  const Outcome outcome = run_cleft("cut", arguments);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  return read_mesh(in / "cut.vtp");
}

TEST(FarMesh, IsCutAsAtTheOriginButForRounding) {
  const TemporaryFolder in;
  std::mt19937 random(1);
  for (int n = 0; n < 12; ++n) {
    SCOPED_TRACE(n);
    const std::vector<std::vector<std::array<double, 2>>> paths{some_places(random), some_places(random)};
    const Vec3 by{0x1.8p25, -0x1p25, 0x1p25};  // two million diameters
    const SurfaceMesh here = cut_of(in, paths, {}), far = cut_of(in, paths, by);
    ASSERT_EQ(here.points.size(), far.points.size());
    EXPECT_EQ(here.triangles, far.triangles);
    // The path's places between those given are rounded where they are, by up to two units a coordinate, and
    // the result by half a unit: 4.3 in space, and twice that along an edge that is crossed at 30 degrees.
    double most = 0;
    for (std::size_t i = 0; i < here.points.size(); ++i)
      most = std::max(most, norm(far.points[i] - by - here.points[i]));
    EXPECT_LE(most, 9 * unit);
  }
}

}  // namespace
}  // namespace cleft
