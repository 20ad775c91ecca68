// The snapshot as another program reads it: VTK's own reader of VTKHDF.
#include <gtest/gtest.h>
#include <vtkCellData.h>
#include <vtkCellSizeFilter.h>
#include <vtkDataArray.h>
#include <vtkHDFReader.h>
#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>

#include "tests/pipeline/commands.h"
#include "tests/support/temporary_folder.h"

namespace cleft {

TEST(VtkHdf, VtkReadsTheMeshWithItsVolumes) {
  const TemporaryFolder folder;
  folder.write(
      "case.toml",
      "[case]\npatch.length = 20\npatch.width = 12\npatch.height = 4\ncut.length = 10\ncut.depth = 2\n");
  expect_success(run_cleft("solve", {folder / "case.toml", "--out", folder / "case.h5", "--no-estimate"}));

  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_ERROR);  // VTK 9.1 warns that 2.0 is newer than it is
  vtkNew<vtkHDFReader> reader;
  ASSERT_TRUE(reader->CanReadFile((folder / "case.h5").c_str()));
  reader->SetFileName((folder / "case.h5").c_str());
  reader->Update();
  auto* grid = vtkUnstructuredGrid::SafeDownCast(reader->GetOutput());
  ASSERT_NE(grid, nullptr);
  ASSERT_NE(grid->GetPointData()->GetArray("displacement"), nullptr);

  vtkNew<vtkCellSizeFilter> sizes;
  sizes->SetInputData(grid);
  sizes->Update();
  vtkCellData* cells = vtkDataSet::SafeDownCast(sizes->GetOutput())->GetCellData();
  double volume = 0, area = 0;
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c) {
    if (grid->GetCellType(c) == VTK_WEDGE) {
      EXPECT_GT(cells->GetArray("Volume")->GetTuple1(c), 0) << "an inverted wedge";
    }
    volume += cells->GetArray("Volume")->GetTuple1(c);
    area += cells->GetArray("Area")->GetTuple1(c);
  }
  EXPECT_NEAR(volume, 20 * 12 * 4, 1e-9);
  EXPECT_NEAR(area, 20 * 12, 1e-9);
}

}  // namespace cleft
