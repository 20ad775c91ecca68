// cleft export of fields: surfaces moved as the field predicts, and pictures for every case, time and camera.
#include <gtest/gtest.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/text.h"
#include "encoder/field/file/field_file.h"
#include "tests/pipeline/commands.h"
#include "tests/support/temporary_folder.h"

namespace cleft {

namespace fs = std::filesystem;

namespace {

Field waves() {
  const auto u = BSplineBasis::uniform(3, 6, -6, 6), w = BSplineBasis::uniform(3, 5, -4, 0),
             t = BSplineBasis::uniform(3, 5, 0, 6);
  const auto v = BSplineBasis::broken(3, 8, -5, 0, 5);
  std::vector<Vec3> points(static_cast<std::size_t>(u.size() * v.size() * w.size() * t.size()));
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double across = static_cast<double>(i / (t.size() * w.size()) % v.size());
    const double along = static_cast<double>(i % t.size());
    points[i] = {0.01 * across * along, (2 * across > v.size() ? 0.2 : -0.2) * along, 0.02 * along};
  }
  return {u, v, w, t, points, CanonicalCut{-3, 6, 2}};
}

}  // namespace

TEST(DecodedExport, MovesTheSurfaceAsTheFieldSays) {
  const TemporaryFolder place;
  const Field field = waves();
  write_field(place / "case.dffd", field);
  const auto figures = nlohmann::json::parse(
      expect_success(run_cleft("export", {place / "case.dffd", "--paraview", place / "out.pvd", "--frames",
                                          "3", "--json"}))
          .output);
  EXPECT_EQ(figures["frames"], 3);
  for (int frame = 0; frame < 3; ++frame) {
    vtkNew<vtkXMLUnstructuredGridReader> reader;
    reader->SetFileName((place / "out/frame_000").append(std::to_string(frame) + ".vtu").c_str());
    reader->Update();
    vtkUnstructuredGrid* grid = reader->GetOutput();
    vtkDataArray* moved = grid->GetPointData()->GetArray("displacement");
    ASSERT_TRUE(moved);
    ASSERT_GT(grid->GetNumberOfPoints(), 100);
    double worst = 0;
    int compared = 0;
    for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i) {
      double p[3], d[3];
      grid->GetPoint(i, p), moved->GetTuple(i, d);
      if (std::abs(p[1]) < 1e-6) continue;  // a lip: which one, its place does not tell
      const Vec3 expected =
          field.displacement({p[0], p[1], p[2]}, p[1] < 0 ? Side::left : Side::right, 3. * frame);
      worst = std::max(worst, norm(Vec3{d[0], d[1], d[2]} - expected));
      ++compared;
    }
    EXPECT_GT(compared, 100);
    EXPECT_LT(worst, 1e-7) << frame;  // places have 32 bits in the file: 5e-7 mm, where slopes are below 0.2
  }
}

TEST(DecodedExport, CinemaHasAPictureForEveryRow) {
  const TemporaryFolder place;
  write_field(place / "case.dffd", waves());
  expect_success(run_cleft(
      "export", {place / "case.dffd", "--cinema", place / "out.cdb", "--times", "2", "--size", "64,48"}));
  const std::string rows = read_text_file(place / "out.cdb/data.csv");
  EXPECT_EQ(std::count(rows.begin(), rows.end(), '\n'), 1 + 2 * 2);
  EXPECT_EQ(rows.substr(rows.find('\n') - 4, 4), "FILE");  // Spec D: the last column names the file
  for (std::size_t at = rows.find('\n') + 1; at < rows.size(); at = rows.find('\n', at) + 1) {
    const std::size_t end = rows.find('\n', at), comma = rows.rfind(',', end);
    EXPECT_EQ(read_text_file(place / ("out.cdb/" + rows.substr(comma + 1, end - comma - 1))).substr(1, 3),
              "PNG");
  }
  const Outcome again = run_cleft("export", {place / "case.dffd", "--cinema", place / "out.cdb"});
  EXPECT_EQ(again.exit_code, 2);
  EXPECT_NE(again.output.find("exists"), std::string::npos);
}

}  // namespace cleft
