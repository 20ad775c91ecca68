// Series for ParaView, read back with VTK's own readers.
#include "explorer/io/paraview_file.h"

#include <gtest/gtest.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLUnstructuredGridReader.h>
#include <vtkXMLUtilities.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "base/text.h"
#include "tests/io/wedge_row.h"
#include "tests/snapshot/point_array.h"
#include "tests/support/temporary_folder.h"

namespace cleft {

namespace fs = std::filesystem;

namespace {

struct Step {
  double time;
  std::string file;
};

std::vector<Step> steps_of(const std::string& pvd) {
  auto root = vtkSmartPointer<vtkXMLDataElement>::Take(vtkXMLUtilities::ReadElementFromFile(pvd.c_str()));
  std::vector<Step> steps;
  if (!root || root->GetAttribute("type") != std::string("Collection")) return steps;
  vtkXMLDataElement* collection = root->FindNestedElementWithName("Collection");
  for (int i = 0; collection && i < collection->GetNumberOfNestedElements(); ++i) {
    vtkXMLDataElement* one = collection->GetNestedElement(i);
    steps.push_back({std::atof(one->GetAttribute("timestep")),
                     (fs::path(pvd).parent_path() / one->GetAttribute("file")).string()});
  }
  return steps;
}

std::vector<double> values(vtkDataArray* array) {
  if (!array) return {};
  std::vector<double> numbers;
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
    for (int c = 0; c < array->GetNumberOfComponents(); ++c) numbers.push_back(array->GetComponent(i, c));
  return numbers;
}

vtkSmartPointer<vtkUnstructuredGrid> read_grid(const std::string& file) {
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  return reader->GetOutput();
}

std::vector<double> flat(const std::vector<Vec3>& points) {
  std::vector<double> numbers;
  for (const Vec3& p : points) numbers.insert(numbers.end(), {p.x, p.y, p.z});
  return numbers;
}

}  // namespace

// Exact: doubles are written as they are. 1000 wedges make arrays of several compressed blocks.
TEST(ParaviewFile, VtkReadsBackEveryNumber) {
  const TemporaryFolder folder;
  const Snapshot s = wedge_row(1000, {0, 0.1, 1.0 / 3, 12});
  const std::size_t points = s.points.size();
  write_snapshot(folder / "case.h5", s);
  const std::vector<double> compliance = random_numbers(points, 11), dent = random_numbers(3 * points, 12),
                            derivative = random_numbers(4 * 3 * points, 13);
  add_point_array(folder / "case.h5", "compliance", compliance, {points});
  add_point_array(folder / "case.h5", "dent", dent, {points, 3});
  add_point_array(folder / "case.h5", "displacement_per_skin.prestress_v", derivative, {4 * points, 3});

  const ExportFigures figures =
      write_paraview_series(SnapshotReader(folder / "case.h5"), folder.path(), "out");
  const std::vector<Step> steps = steps_of(folder / "out.pvd");
  ASSERT_EQ(steps.size(), 4u);
  EXPECT_EQ(figures.frames, 4u);
  EXPECT_EQ(figures.files, 5u);
  std::uintmax_t bytes = fs::file_size(folder / "out.pvd");
  for (std::size_t j = 0; j < 4; ++j) {
    bytes += fs::file_size(steps[j].file);
    EXPECT_EQ(steps[j].time, s.times[j]);
    const auto grid = read_grid(steps[j].file);
    EXPECT_EQ(values(grid->GetPoints()->GetData()), flat(s.points));
    vtkPointData* data = grid->GetPointData();
    EXPECT_EQ(data->GetNumberOfArrays(), 4);
    EXPECT_EQ(values(data->GetArray("displacement")), displacements(s, j)) << "frame " << j;
    EXPECT_EQ(data->GetVectors(), data->GetArray("displacement")) << "what ParaView warps by";
    EXPECT_EQ(values(data->GetArray("compliance")), compliance);
    EXPECT_EQ(values(data->GetArray("dent")), dent);
    const auto* first = &derivative[j * 3 * points];
    EXPECT_EQ(values(data->GetArray("displacement_per_skin.prestress_v")),
              std::vector<double>(first, first + 3 * points));
    EXPECT_EQ(values(grid->GetFieldData()->GetArray("TimeValue")), std::vector<double>{s.times[j]});

    ASSERT_EQ(grid->GetNumberOfCells(), 2000);
    vtkDataArray* part = grid->GetCellData()->GetArray("part");
    ASSERT_NE(part, nullptr);
    for (vtkIdType c = 0; c < 2000; ++c) {
      ASSERT_EQ(grid->GetCellType(c), s.cell_types[c]);
      ASSERT_EQ(part->GetTuple1(c), c % 2);
    }
    EXPECT_EQ(values(grid->GetCells()->GetOffsetsArray()),
              std::vector<double>(s.cell_offsets.begin(), s.cell_offsets.end()));
    EXPECT_EQ(values(grid->GetCells()->GetConnectivityArray()),
              std::vector<double>(s.connectivity.begin(), s.connectivity.end()));
  }
  EXPECT_EQ(figures.bytes, bytes);
}

// Raw appended data are no XML: VTK with an expat of 2024 or later stumbles over them.
TEST(ParaviewFile, EveryFileIsValidXml) {
  const TemporaryFolder folder;
  write_snapshot(folder / "case.h5", wedge_row(1000, {0, 1}));
  const std::string name = "a & \"b\" <c>";
  write_paraview_series(SnapshotReader(folder / "case.h5"), folder.path(), name);
  const std::vector<Step> steps = steps_of(folder / (name + ".pvd"));
  ASSERT_EQ(steps.size(), 2u);
  for (const Step& step : steps) {
    const std::string text = read_text_file(step.file);
    EXPECT_TRUE(
        std::all_of(text.begin(), text.end(), [](char c) { return c == '\n' || (' ' <= c && c <= '~'); }));
    EXPECT_TRUE(text.ends_with("</VTKFile>\n"));
    EXPECT_NE(text.find("header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\""), std::string::npos);
  }
}

}  // namespace cleft
