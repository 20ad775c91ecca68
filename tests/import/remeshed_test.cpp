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

/// Values at nodes of the earlier meshes, which the last one does not have.
TEST(Remeshed, NodesAtEarlierFrontsAreAdded) {
  const RemeshedSeries series;
  const ImportedSeries imported(series.pvd, parse_fields({"displacement"}));
  const std::size_t own = at_time(12).series().mesh.points.size();
  ASSERT_GT(imported.mesh().points.size(), own + 300);
  EXPECT_LT(imported.mesh().points.size(), own + 3000);
  double worst = 0;
  for (const std::size_t j : {2, 7, 11}) {
    const FieldValues values = imported.frame(j);
    const CrackedBody body = at_time(static_cast<double>(j));
    const double front = 2. * static_cast<double>(j);
    for (std::size_t n = own; n < imported.mesh().points.size(); ++n) {
      const Vec3 p = imported.mesh().points[n];
      if (std::abs(p.x - front) > 0.51) continue;  // nodes of this frame's own mesh
      const Vec3 exact = body.displacement(p, 0, static_cast<double>(j));
      const Vec3 found{values[0][3 * n], values[0][3 * n + 1], values[0][3 * n + 2]};
      worst = std::max(worst, norm(found - exact));
    }
  }
  EXPECT_LT(worst, 1e-9);
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
