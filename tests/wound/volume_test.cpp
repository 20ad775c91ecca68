// A mesh of volume is cut where its surface is, and its points move with it.
#include <gtest/gtest.h>

#include <array>
#include <fstream>
#include <map>

#include "explorer/commands/cut_volume.h"
#include "explorer/wound/replayed_wounds.h"
#include "tests/incision/meshes.h"
#include "tests/support/temporary_folder.h"
#include "tests/wound/fields.h"

namespace cleft {
namespace {

using namespace testing;

/// A box of tetrahedra, six a cube; the top at z = 0. `y` runs so that no points stand on y = 0.
std::string box(const TemporaryFolder& folder, int nx, int ny, int nz) {
  std::ostringstream points, cells;
  int count = 0;
  const auto index = [&](int i, int j, int k) { return (k * (ny + 1) + j) * (nx + 1) + i; };
  for (int k = 0; k <= nz; ++k)
    for (int j = 0; j <= ny; ++j)
      for (int i = 0; i <= nx; ++i)
        points << i - nx / 2. << ' ' << j - ny / 2. + 0.3 << ' ' << k - nz << '\n';
  const int orders[6][3] = {{0, 1, 2}, {1, 0, 2}, {0, 2, 1}, {2, 0, 1}, {1, 2, 0}, {2, 1, 0}};
  for (int k = 0; k < nz; ++k)
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i)
        for (int o = 0; o < 6; ++o) {  // from corner to corner along the axes in every order
          int at[3] = {i, j, k}, corner[4];
          corner[0] = index(i, j, k);
          for (int s = 0; s < 3; ++s) {
            ++at[orders[o][s]];
            corner[s + 1] = index(at[0], at[1], at[2]);
          }
          const bool turned = o == 1 || o == 2 || o == 5;
          if (turned) std::swap(corner[1], corner[2]);
          for (const int c : corner) cells << c << ' ';
          cells << '\n';
          ++count;
        }
  std::ostringstream file;
  file << "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\"><UnstructuredGrid><Piece NumberOfPoints=\""
       << (nx + 1) * (ny + 1) * (nz + 1) << "\" NumberOfCells=\"" << count
       << "\"><Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">" << points.str()
       << "</DataArray></Points><Cells><DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">"
       << cells.str() << "</DataArray><DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">";
  for (int c = 1; c <= count; ++c) file << 4 * c << ' ';
  file << "</DataArray><DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">";
  for (int c = 0; c < count; ++c) file << "10 ";
  file << "</DataArray></Cells></Piece></UnstructuredGrid></VTKFile>";
  return folder.write("box.vtu", file.str());
}

TEST(Volume, IsSplitWhereTheBladePassesAndKeepsItsSize) {
  const TemporaryFolder folder;
  VolumeMesh volume(box(folder, 20, 16, 6));
  EXPECT_NEAR(volume.size(), 20 * 16 * 6, 1e-9 * 20 * 16 * 6);
  const SurfaceMesh surface = volume.surface();
  EXPECT_EQ(surface.triangles.size(), 2u * 2 * (20 * 16 + 20 * 6 + 16 * 6));
  Incision cut(surface, path_through({{-5.2, 0, 0}, {5.2, 0, 0}}, up, 3));
  cut.advance_to(10.4);
  const int added = write_cut_volume(volume, surface, {&cut}, nullptr, 1, 10.4, folder / "closed.vtu");
  EXPECT_GT(added, 10 * 3 * 6);
  const VolumeMesh closed(folder / "closed.vtu");
  EXPECT_EQ(closed.cells(), volume.cells());
  EXPECT_NEAR(closed.size(), 20 * 16 * 6, 1e-9 * 20 * 16 * 6);
}

TEST(Volume, MovesAsItsSurfaceDoesAndGapesAsWide) {
  const TemporaryFolder folder;
  VolumeMesh volume(box(folder, 20, 16, 6));
  const SurfaceMesh surface = volume.surface();
  const Field field = opening_field({-5, 10, 3}, 20, 16, 6, 2);
  Incision cut(surface, path_through({{-5, 0, 0}, {5, 0, 0}}, up, 3));
  cut.advance_to(10);
  const ReplayedWounds wounds({Wound(cut, field, 1)});
  write_cut_volume(volume, surface, {&cut}, &wounds, 1, 10, folder / "open.vtu");
  const std::vector<Vec3> rest = volume.points(), moved = VolumeMesh(folder / "open.vtu").points();
  ASSERT_EQ(rest.size(), moved.size());
  std::vector<Vec3> skin(wounds.vertex_count());
  wounds.positions(10, skin);
  double left = 0, right = 0;
  for (std::size_t i = 0; i < rest.size(); ++i) {
    if (rest[i].z < -1e-9) continue;
    // Beside the cut the box's own points are vertices of its surface.
    for (std::size_t v = 0; v < surface.points.size(); ++v)
      if (norm(surface.points[v] - rest[i]) < 1e-9 && std::abs(rest[i].y) > 0.1) {
        EXPECT_LT(norm(moved[i] - skin[v]), 1e-9) << rest[i].x << ' ' << rest[i].y;
      }
    if (std::abs(rest[i].y) > 1e-9 || std::abs(rest[i].x) > 4) continue;
    for (const Side side : {Side::left, Side::right}) {
      const Vec3 d = moved[i] - rest[i] - field.displacement(rest[i], side, 10);
      if (norm(d) < 1e-9) (side == Side::left ? left : right) += 1;
    }
  }
  EXPECT_GT(left, 5);
  EXPECT_EQ(left, right);
}

TEST(Volume, IsSplitAsFarAsTheBladeGoesAndNoFurther) {
  // The blade begins, ends and reaches down within cells: they open as far as it is in them.
  const TemporaryFolder folder;
  VolumeMesh volume(box(folder, 20, 16, 6));
  const SurfaceMesh surface = volume.surface();
  const Field field = opening_field({-4.7, 8.1, 2.4}, 20, 16, 6, 2);
  const double start = -4.7, tip = 3.4, depth = 2.4;
  Incision cut(surface, path_through({{start, 0, 0}, {tip, 0, 0}}, up, depth));
  cut.advance_to(tip - start);
  const ReplayedWounds wounds({Wound(cut, field, 1)});
  write_cut_volume(volume, surface, {&cut}, &wounds, 1, tip - start, folder / "open.vtu");
  const VolumeMesh open(folder / "open.vtu");
  const std::vector<Vec3> rest = volume.points(), moved = open.points();
  EXPECT_NEAR(volume.size(), 20 * 16 * 6, 1e-9 * 20 * 16 * 6);
  const std::vector<int> parts = volume.parts(0);
  double first = 0, last = 0, deepest = 0;
  for (std::size_t i = 0; i < rest.size(); ++i) {
    if (parts[i] == 0 || std::abs(rest[i].y) > 1e-9) continue;
    first = std::min(first, rest[i].x), last = std::max(last, rest[i].x);
    deepest = std::max(deepest, -rest[i].z);
  }
  EXPECT_NEAR(first, start, 1e-9);
  EXPECT_NEAR(last, tip, 1e-9);
  EXPECT_NEAR(deepest, depth, 1e-9);
  // The lips' area is the blade's way: every point of it in the middle of the wound has come apart.
  std::map<std::array<double, 3>, double> least, most;
  for (std::size_t i = 0; i < rest.size(); ++i) {
    if (std::abs(rest[i].y) > 1e-9) continue;
    const std::array<double, 3> place{rest[i].x, 0, rest[i].z};
    const double gap = moved[i].y - rest[i].y;
    least[place] = std::min(least[place], gap), most[place] = std::max(most[place], gap);
  }
  int apart = 0;
  for (const auto& [place, low] : least) {
    const bool inside = place[0] > start + 0.05 && place[0] < tip - 0.05 && place[2] > -depth + 0.05;
    const bool outside = place[0] > tip || place[0] < start || place[2] < -depth;
    if (inside) {
      EXPECT_GT(most[place] - low, 0.01) << place[0] << ' ' << place[2];
      ++apart;
    }
    if (outside) {
      EXPECT_EQ(most[place], low) << place[0] << ' ' << place[2];
    }
  }
  EXPECT_GT(apart, 20);
}

}  // namespace
}  // namespace cleft
