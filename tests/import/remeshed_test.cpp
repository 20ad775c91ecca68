// A crack that grows through a mesh that is made anew for every frame, fine at its front.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "base/text.h"
#include "encoder/field/file/field_file.h"
#include "encoder/import/series.h"
#include "tests/import/cracked_bodies.h"
#include "tests/pipeline/commands.h"
#include "tests/support/temporary_folder.h"

namespace cleft {

namespace {

/// edge_crack() at one time: its front is at a = 2 t, with planes of nodes that are dense there.
CrackedBody at_time(double t) {
  CrackedBody body = edge_crack();
  const double front = 2 * t;
  std::vector<double> a;
  for (int i = 0; i <= 40; ++i) a.push_back(i);
  for (const double off : {-0.5, -0.25, 0.25, 0.5})
    if (front + off > 0 && front + off < 40) a.push_back(front + off);
  std::sort(a.begin(), a.end());
  body.a = a, body.times = {t};
  body.doubled = [front](const Vec3& abc) { return abc.x < front; };
  return body;
}

struct RemeshedSeries {
  TemporaryFolder folder;
  std::vector<double> times;
  std::string pvd = folder / "series.pvd";

  RemeshedSeries() {
    std::ofstream list(pvd);
    list << "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n";
    for (int j = 0; j <= 12; ++j) {
      times.push_back(j);
      const std::string file = "frame_" + std::to_string(j) + ".vtu";
      folder.write(file, at_time(j).series().vtu(0));
      list << "<DataSet timestep=\"" << j << "\" part=\"0\" file=\"" << file << "\"/>\n";
    }
    list << "</Collection>\n</VTKFile>\n";
  }
};

/// Of nodes with b = 0, by the other corners of their cells; 0 where they are on both sides.
std::vector<int> sides_at_break(const SourceMesh& mesh) {
  std::vector<std::array<bool, 2>> has(mesh.points.size(), {false, false});
  for (std::size_t c = 0; c < mesh.cell_types.size(); ++c) {
    double y = 0;
    for (auto i = mesh.cell_offsets[c]; i < mesh.cell_offsets[c + 1]; ++i)
      y += mesh.points[mesh.connectivity[i]].y;
    for (auto i = mesh.cell_offsets[c]; i < mesh.cell_offsets[c + 1] && y != 0; ++i)
      has[mesh.connectivity[i]][y > 0] = true;
  }
  std::vector<int> sides;
  sides.reserve(has.size());
  for (const auto& [left, right] : has) sides.push_back(left == right ? 0 : right ? 1 : -1);
  return sides;
}

}  // namespace

TEST(Remeshed, ACrackOpensAsInOneMesh) {
  const RemeshedSeries series;
  const std::string h5 = series.folder / "case.h5", dffd = series.folder / "case.dffd";
  const auto imported = run_cleft("import", {series.pvd, "--field", "displacement", "--out", h5, "--json"});
  expect_success(imported);
  EXPECT_NE(imported.output.find("12 frames have another mesh"), std::string::npos) << imported.output;
  expect_success(run_cleft("encode", {h5, "--tolerance", "0.01", "--out", dffd}));
  const Field field = read_field(dffd);
  EXPECT_EQ(field.cut().length, 24);
  // Against the closed form: the opening along the crack, at all frames.
  const CrackedBody body = edge_crack();
  double worst = 0, largest = 0;
  for (const double t : series.times)
    for (double a = 0.5; a < 40; a += 1)
      for (const double c : {-6., -2.5, 0.}) {
        const Vec3 place{a, 0, c};
        const Vec3 there =
            a < 2 * t ? body.displacement(place, 1, t) - body.displacement(place, -1, t) : Vec3{};
        const Vec3 uvw = field.source->canonical(place);
        const Vec3 d = field.displacement(uvw, Side::right, t) - field.displacement(uvw, Side::left, t);
        const double sign = field.source->axes[1].y;
        largest = std::max(largest, norm(there));
        worst = std::max(worst, std::abs(std::abs(d.y) - std::abs(there.y)) + (sign == 0 ? 1 : 0));
      }
  EXPECT_GT(largest, 0.5);
  EXPECT_LT(worst, 0.04 * largest) << "at half a unit from the front, where meshes have nodes of one frame";
}

/// Values at nodes of the earlier meshes, which the last one does not have: on both lips where it is cut.
TEST(Remeshed, NodesAtEarlierFrontsAreAdded) {
  const RemeshedSeries series;
  const ImportedSeries imported(series.pvd, parse_fields({"displacement"}));
  const SourceMesh& mesh = imported.mesh();
  const std::size_t own = at_time(12).series().mesh.points.size();
  ASSERT_GT(mesh.points.size(), own + 300);
  EXPECT_LT(mesh.points.size(), own + 3000);
  const std::vector<int> sides = sides_at_break(mesh);
  double worst = 0;
  int on_lips = 0;
  for (const std::size_t j : {2, 7, 11}) {
    const FieldValues values = imported.frame(j);
    const CrackedBody body = at_time(static_cast<double>(j));
    const double front = 2. * static_cast<double>(j);
    for (std::size_t n = own; n < mesh.points.size(); ++n) {
      const Vec3 p = mesh.points[n];
      if (std::abs(p.x - front) > 0.51) continue;  // nodes of this frame's own mesh
      const bool open = p.y == 0 && p.x < front;
      ASSERT_TRUE(!open || sides[n] != 0);
      on_lips += open ? sides[n] : 0;
      const Vec3 exact = body.displacement(p, open ? sides[n] : 0, static_cast<double>(j));
      const Vec3 found{values[0][3 * n], values[0][3 * n + 1], values[0][3 * n + 2]};
      worst = std::max(worst, norm(found - exact));
      on_lips += open ? 100 : 0;
    }
  }
  EXPECT_EQ(on_lips, 100 * 2 * 2 * 5 * 3) << "five nodes a line across the front, two lines, both lips";
  EXPECT_LT(worst, 1e-9);
}

TEST(Remeshed, NothingIsLostOnTheBreak) {
  const RemeshedSeries series;
  const auto imported =
      run_cleft("import", {series.pvd, "--field", "displacement", "--out", series.folder / "case.h5"});
  expect_success(imported);
  EXPECT_NE(imported.output.find("of their own where more than 0.1 % of the largest would be lost"),
            std::string::npos)
      << imported.output;
  EXPECT_EQ(imported.output.find("on the break"), std::string::npos) << imported.output;
}

/// In each frame's mesh the mean of a node's cells, which are those of its side where the crack is open.
TEST(Remeshed, ValuesOfCellsAreMeansAtNodes) {
  const RemeshedSeries series;
  for (int j = 0; j <= 12; ++j) {
    const SourceSeries frame = at_time(j).series();
    std::string text = frame.vtu(0), numbers;
    for (std::size_t c = 0; c < frame.mesh.cell_types.size(); ++c) {
      double y = 0;
      for (auto i = frame.mesh.cell_offsets[c]; i < frame.mesh.cell_offsets[c + 1]; ++i)
        y += frame.mesh.points[frame.mesh.connectivity[i]].y;
      numbers += y > 0 ? "4 " : "2 ";
    }
    text.insert(text.find("<Points>"),
                "<CellData>\n<DataArray type=\"Float64\" Name=\"heat\" format=\"ascii\">\n" + numbers +
                    "\n</DataArray>\n</CellData>\n");
    series.folder.write("frame_" + std::to_string(j) + ".vtu", text);
  }
  const ImportedSeries imported(series.pvd, parse_fields({"heat", "displacement"}));
  EXPECT_TRUE(imported.fields()[0].of_means);
  EXPECT_FALSE(imported.fields()[1].of_means);
  const SourceMesh& mesh = imported.mesh();
  const std::vector<int> sides = sides_at_break(mesh);
  for (const std::size_t j : {3, 8, 12}) {
    const FieldValues values = imported.frame(j);
    ASSERT_EQ(values[0].size(), mesh.points.size());
    ASSERT_EQ(values[1].size(), 3 * mesh.points.size());
    int seen = 0;
    for (std::size_t n = 0; n < mesh.points.size(); ++n) {
      const Vec3& p = mesh.points[n];
      const double front = 2. * static_cast<double>(j);
      if (p.y != 0 || std::abs(p.x - front) < 1.01) continue;
      EXPECT_NEAR(values[0][n], p.x < front ? 3 + sides[n] : 3, 1e-9) << j << " " << p.x;
      ++seen;
    }
    EXPECT_GT(seen, 200);
  }
}

TEST(Remeshed, AnotherBodyIsRefusedWithTheFrame) {
  const RemeshedSeries series;
  CrackedBody longer = at_time(3);
  longer.place = [](const Vec3& abc) { return Vec3{abc.x * 0.8, abc.y, abc.z}; };
  series.folder.write("frame_3.vtu", longer.series().vtu(0));
  const auto refused =
      run_cleft("import", {series.pvd, "--field", "displacement", "--out", series.folder / "case.h5"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.output.find("frame_3.vtu"), std::string::npos) << refused.output;
  EXPECT_FALSE(std::filesystem::exists(series.folder / "case.h5"));
}

}  // namespace cleft
