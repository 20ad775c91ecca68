#include "encoder/import/vtk_frames.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCompositeDataIterator.h>
#include <vtkCompositeDataSet.h>
#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPointSet.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkTypeInt64Array.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>

#include "base/error.h"

namespace cleft {

namespace {

/// Contiguous values of the type of `To`, whatever VTK keeps.
template <class To, class T>
std::vector<T> values_of(vtkDataArray* array) {
  vtkNew<To> copy;
  copy->DeepCopy(array);
  return {copy->GetPointer(0), copy->GetPointer(0) + copy->GetNumberOfValues()};
}

/// All grids with points; surfaces only where there are no grids, whose boundaries they are then.
std::vector<vtkPointSet*> blocks_of(vtkDataObject* data) {
  std::vector<vtkPointSet*> grids, surfaces;
  const auto add = [&](vtkDataObject* one) {
    auto* points = vtkPointSet::SafeDownCast(one);
    if (!points || !points->GetPoints() || points->GetNumberOfPoints() == 0) return;
    (vtkPolyData::SafeDownCast(one) ? surfaces : grids).push_back(points);
  };
  if (auto* composite = vtkCompositeDataSet::SafeDownCast(data)) {
    auto it = vtkSmartPointer<vtkCompositeDataIterator>::Take(composite->NewIterator());
    for (it->InitTraversal(); !it->IsDoneWithTraversal(); it->GoToNextItem()) add(it->GetCurrentDataObject());
  } else {
    add(data);
  }
  return grids.empty() ? surfaces : grids;
}

void add_mesh(SourceMesh& mesh, vtkPointSet* points) {
  const auto base = static_cast<std::int64_t>(mesh.points.size());
  const std::vector<double> numbers = values_of<vtkDoubleArray, double>(points->GetPoints()->GetData());
  for (std::size_t i = 0; i + 2 < numbers.size(); i += 3)
    mesh.points.push_back({numbers[i], numbers[i + 1], numbers[i + 2]});
  const auto end = [&] { return static_cast<std::int64_t>(mesh.connectivity.size()); };
  auto* grid = vtkUnstructuredGrid::SafeDownCast(points);
  if (!grid) {  // a surface, whose cells VTK keeps by kind, or a structured grid
    vtkNew<vtkIdList> corners;
    for (vtkIdType c = 0; c < points->GetNumberOfCells(); ++c) {
      points->GetCellPoints(c, corners);
      mesh.cell_types.push_back(static_cast<std::uint8_t>(points->GetCellType(c)));
      for (const vtkIdType corner : *corners) mesh.connectivity.push_back(base + corner);
      mesh.cell_offsets.push_back(end());
    }
    return;
  }
  if (grid->GetNumberOfCells() == 0) return;
  const auto types = values_of<vtkUnsignedCharArray, std::uint8_t>(grid->GetCellTypesArray());
  const auto offsets = values_of<vtkTypeInt64Array, std::int64_t>(grid->GetCells()->GetOffsetsArray());
  const auto corners = values_of<vtkTypeInt64Array, std::int64_t>(grid->GetCells()->GetConnectivityArray());
  const std::int64_t first = end();
  mesh.cell_types.insert(mesh.cell_types.end(), types.begin(), types.end());
  for (std::size_t c = 1; c < offsets.size(); ++c) mesh.cell_offsets.push_back(first + offsets[c]);
  for (const std::int64_t corner : corners) mesh.connectivity.push_back(base + corner);
}

void add_array(SourceArray& all, vtkDataArray* array, bool is_first, const std::string& name,
               const std::string& path) {
  if (!array) throw FileError(path, "the array '" + name + "' holds no numbers, or a block lacks it");
  if (!is_first && all.components != array->GetNumberOfComponents())
    throw FileError(path, "the array '" + name + "' has other components in another block");
  all.components = array->GetNumberOfComponents();
  all.single = all.single || array->GetDataType() == VTK_FLOAT;
  const std::vector<double> values = values_of<vtkDoubleArray, double>(array);
  all.values.insert(all.values.end(), values.begin(), values.end());
}

/// Names that all blocks have.
template <class DataOf>
std::vector<std::string> names_in(vtkDataObject* data, const DataOf& data_of) {
  std::vector<std::string> names;
  bool is_first = true;
  for (vtkPointSet* block : blocks_of(data)) {
    auto* arrays = data_of(block);
    std::vector<std::string> here;
    for (int i = 0; i < arrays->GetNumberOfArrays(); ++i)
      if (arrays->GetArray(i) && arrays->GetArrayName(i)) here.emplace_back(arrays->GetArrayName(i));
    if (is_first) names = here;
    std::erase_if(names,
                  [&](const std::string& n) { return std::find(here.begin(), here.end(), n) == here.end(); });
    is_first = false;
  }
  return names;
}

}  // namespace

std::vector<std::string> point_array_names(vtkDataObject* data) {
  return names_in(data, [](vtkPointSet* block) { return block->GetPointData(); });
}

std::vector<std::string> cell_array_names(vtkDataObject* data) {
  return names_in(data, [](vtkPointSet* block) { return block->GetCellData(); });
}

SourceFrame frame_of(vtkDataObject* data, const WantedArrays& wanted, const std::string& path) {
  const std::vector<vtkPointSet*> blocks = blocks_of(data);
  if (blocks.empty()) throw FileError(path, "holds no points of a grid or a surface");
  SourceFrame frame;
  frame.mesh.cell_offsets = {0};
  frame.arrays.resize(wanted.points.size()), frame.cell_arrays.resize(wanted.cells.size());
  for (vtkPointSet* block : blocks) {
    if (auto* cells = vtkUnstructuredGrid::SafeDownCast(block)) cells->RemoveGhostCells();
    const bool is_first = block == blocks.front();
    add_mesh(frame.mesh, block);
    for (std::size_t a = 0; a < wanted.points.size(); ++a)
      add_array(frame.arrays[a], block->GetPointData()->GetArray(wanted.points[a].c_str()), is_first,
                wanted.points[a], path);
    for (std::size_t a = 0; a < wanted.cells.size(); ++a)
      add_array(frame.cell_arrays[a], block->GetCellData()->GetArray(wanted.cells[a].c_str()), is_first,
                wanted.cells[a], path);
  }
  return frame;
}

vtkSmartPointer<vtkUnstructuredGrid> grid_of(const SourceMesh& mesh) {
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const Vec3& p : mesh.points) points->InsertNextPoint(p.x, p.y, p.z);
  grid->SetPoints(points);
  grid->Allocate(static_cast<vtkIdType>(mesh.cell_types.size()));
  for (std::size_t c = 0; c < mesh.cell_types.size(); ++c) {
    const std::vector<vtkIdType> corners(mesh.connectivity.begin() + mesh.cell_offsets[c],
                                         mesh.connectivity.begin() + mesh.cell_offsets[c + 1]);
    grid->InsertNextCell(mesh.cell_types[c], static_cast<vtkIdType>(corners.size()), corners.data());
  }
  return grid;
}

bool has_pieces(vtkDataObject* data) { return blocks_of(data).size() > 1; }

}  // namespace cleft
