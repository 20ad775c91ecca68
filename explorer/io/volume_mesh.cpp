#include "explorer/io/volume_mesh.h"

#include <vtkAppendFilter.h>
#include <vtkCellData.h>
#include <vtkCellSizeFilter.h>
#include <vtkDataSetSurfaceFilter.h>
#include <vtkDataSetTriangleFilter.h>
#include <vtkDoubleArray.h>
#include <vtkExtractCells.h>
#include <vtkGenericCell.h>
#include <vtkIdList.h>
#include <vtkIntArray.h>
#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkStaticCellLocator.h>
#include <vtkTableBasedClipDataSet.h>
#include <vtkTriangleFilter.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/error.h"
#include "base/output_file.h"
#include "base/vtk_listener.h"
#include "explorer/io/polygons.h"

namespace cleft {

namespace {

constexpr const char* level_name = "cleft beside the cut";

std::string part_name(int split) { return "cleft part " + std::to_string(split); }

vtkSmartPointer<vtkPoints> double_points(const std::vector<Vec3>& places) {
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(static_cast<vtkIdType>(places.size()));
  for (std::size_t i = 0; i < places.size(); ++i)
    points->SetPoint(static_cast<vtkIdType>(i), places[i].x, places[i].y, places[i].z);
  return points;
}

std::vector<int> corners_of(vtkUnstructuredGrid* grid, vtkIdType cell, vtkIdList* list) {
  grid->GetCellPoints(cell, list);
  return {list->begin(), list->end()};
}

/// The cells of the grid in the list, with points of their own where `clip` splits them at `level` = 0.
void append_cells(vtkUnstructuredGrid* grid, vtkIdList* cells, int part, const std::string& name,
                  vtkAppendFilter* all) {
  if (cells->GetNumberOfIds() == 0) return;
  vtkNew<vtkExtractCells> some;
  some->SetInputData(grid);
  some->SetCellList(cells);
  some->Update();
  auto taken = vtkSmartPointer<vtkUnstructuredGrid>::New();
  if (part == 0) {
    taken->DeepCopy(some->GetOutput());
  } else {
    vtkNew<vtkTableBasedClipDataSet> clip;
    clip->SetInputData(some->GetOutput());
    clip->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, level_name);
    clip->SetValue(0);
    clip->SetInsideOut(part < 0);
    clip->Update();
    if (name.empty()) {  // to be clipped again: of wedges and pyramids VTK's clip loses a little
      vtkNew<vtkDataSetTriangleFilter> tetrahedra;
      tetrahedra->SetInputData(clip->GetOutput());
      tetrahedra->Update();
      taken->DeepCopy(tetrahedra->GetOutput());
    } else {
      taken->DeepCopy(clip->GetOutput());
    }
  }
  if (!name.empty()) {
    vtkNew<vtkIntArray> parts;
    parts->SetName(name.c_str());
    parts->SetNumberOfTuples(taken->GetNumberOfPoints());
    parts->FillValue(part);
    taken->GetPointData()->AddArray(parts);
  }
  all->AddInputData(taken);
}

}  // namespace

struct VolumeMesh::Grid {
  vtkSmartPointer<vtkUnstructuredGrid> cells;
};

VolumeMesh::VolumeMesh(const std::string& path) : path_(path), grid_(std::make_unique<Grid>()) {
  if (!std::filesystem::exists(path)) throw FileError(path, "cannot be opened: does it exist?");
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);  // its errors are reported by us
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(path.c_str());
  const VtkListener reading(reader.Get());
  reader->Update();
  if (reading.failed()) throw FileError(path, "cannot be read as a mesh of volume: " + reading.reason());
  auto all = reader->GetOutput();
  vtkNew<vtkIdList> solid, list;
  for (vtkIdType c = 0; c < all->GetNumberOfCells(); ++c) {
    for (const int p : corners_of(all, c, list))
      if (p < 0 || p >= all->GetNumberOfPoints())
        throw FileError(path, "names point " + std::to_string(p) + "; it has " +
                                  std::to_string(all->GetNumberOfPoints()) + " points");
    vtkNew<vtkGenericCell> cell;
    cell->SetCellType(all->GetCellType(c));
    if (cell->GetCellDimension() == 3) solid->InsertNextId(c);
  }
  if (solid->GetNumberOfIds() == 0) throw FileError(path, "has no cells of volume");
  vtkNew<vtkExtractCells> extract;  // a skin of triangles would be a second surface
  extract->SetInputData(all);
  extract->SetCellList(solid);
  extract->Update();
  grid_->cells = extract->GetOutput();
  const std::vector<Vec3> places = points();
  for (std::size_t i = 0; i < places.size(); ++i)
    if (!std::isfinite(places[i].x + places[i].y + places[i].z))
      throw FileError(path, "point " + std::to_string(i) + " is not a number");
  grid_->cells->SetPoints(double_points(places));
}

VolumeMesh::~VolumeMesh() = default;
VolumeMesh::VolumeMesh(VolumeMesh&&) noexcept = default;

SurfaceMesh VolumeMesh::surface(MeshReport* report) const {
  vtkNew<vtkDataSetSurfaceFilter> outside;
  outside->SetInputData(grid_->cells);
  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputConnection(outside->GetOutputPort());
  triangles->Update();
  return mesh_of_polygons(triangles->GetOutput(), path_, report);
}

std::vector<Vec3> VolumeMesh::points() const {
  std::vector<Vec3> result(static_cast<std::size_t>(grid_->cells->GetNumberOfPoints()));
  for (std::size_t i = 0; i < result.size(); ++i)
    grid_->cells->GetPoint(static_cast<vtkIdType>(i), &result[i].x);
  return result;
}

int VolumeMesh::cells() const { return static_cast<int>(grid_->cells->GetNumberOfCells()); }

double VolumeMesh::size() const {
  vtkNew<vtkCellSizeFilter> measure;
  measure->SetInputData(grid_->cells);
  measure->Update();
  vtkDataArray* volumes = vtkDataSet::SafeDownCast(measure->GetOutput())->GetCellData()->GetArray("Volume");
  double sum = 0;
  for (vtkIdType i = 0; i < volumes->GetNumberOfTuples(); ++i) sum += volumes->GetTuple1(i);
  return sum;
}

std::vector<VolumeMesh::Nearest> VolumeMesh::nearest(const SurfaceMesh& surface) const {
  vtkNew<vtkPolyData> skin;
  vtkNew<vtkCellArray> triangles;
  for (const auto& t : surface.triangles) {
    const vtkIdType corners[3] = {t[0], t[1], t[2]};
    triangles->InsertNextCell(3, corners);
  }
  skin->SetPoints(double_points(surface.points));
  skin->SetPolys(triangles);
  vtkNew<vtkStaticCellLocator> locator;
  locator->SetDataSet(skin);
  locator->BuildLocator();
  vtkNew<vtkGenericCell> cell;
  std::vector<Nearest> result;
  for (const Vec3& p : points()) {
    double x[3] = {p.x, p.y, p.z}, closest[3], squared;
    vtkIdType triangle;
    int unused;
    locator->FindClosestPoint(x, closest, cell, triangle, unused, squared);
    const Vec3 foot{closest[0], closest[1], closest[2]};
    const auto& t = surface.triangles[triangle];
    const auto away = [&](int v) { return squared_norm(surface.points[v] - foot); };
    result.push_back({*std::min_element(t.begin(), t.end(), [&](int a, int b) { return away(a) < away(b); }),
                      std::sqrt(squared)});
  }
  return result;
}

void VolumeMesh::split(const std::vector<double>& level,
                       const std::function<bool(const std::vector<int>&)>& is_cut) {
  clip(level, is_cut, part_name(splits_));
  ++splits_;
}

void VolumeMesh::slice(const std::vector<double>& level,
                       const std::function<bool(const std::vector<int>&)>& is_cut) {
  clip(level, is_cut, "");
}

void VolumeMesh::clip(const std::vector<double>& level,
                      const std::function<bool(const std::vector<int>&)>& is_cut, const std::string& sides) {
  CLEFT_CHECK(level.size(), ==, static_cast<std::size_t>(grid_->cells->GetNumberOfPoints()));
  vtkNew<vtkDoubleArray> values;
  values->SetName(level_name);
  for (const double value : level) values->InsertNextValue(value);
  grid_->cells->GetPointData()->AddArray(values);
  vtkNew<vtkIdList> whole, parted, list;
  for (vtkIdType c = 0; c < grid_->cells->GetNumberOfCells(); ++c) {
    const std::vector<int> corners = corners_of(grid_->cells, c, list);
    const auto [low, high] = std::minmax_element(corners.begin(), corners.end(),
                                                 [&](int a, int b) { return level[a] < level[b]; });
    const bool crossed = level[*low] < 0 && level[*high] > 0;
    (crossed && is_cut(corners) ? parted : whole)->InsertNextId(c);
  }
  vtkNew<vtkAppendFilter> all;
  append_cells(grid_->cells, whole, 0, sides, all);
  append_cells(grid_->cells, parted, -1, sides, all);
  append_cells(grid_->cells, parted, 1, sides, all);
  all->Update();
  grid_->cells = all->GetOutput();
  grid_->cells->GetPointData()->RemoveArray(level_name);
}

std::vector<int> VolumeMesh::parts(int number) const {
  // A later split has points of a part between points of the same part.
  vtkDataArray* array = grid_->cells->GetPointData()->GetArray(part_name(number).c_str());
  std::vector<int> parts;
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
    parts.push_back(static_cast<int>(array->GetTuple1(i)));
  return parts;
}

void VolumeMesh::write(const std::string& path, const std::vector<Vec3>& points,
                       const std::vector<PointArray>& arrays) const {
  vtkNew<vtkUnstructuredGrid> moved;
  moved->ShallowCopy(grid_->cells);
  moved->SetPoints(double_points(points));
  for (int split = 0; split < splits_; ++split) moved->GetPointData()->RemoveArray(part_name(split).c_str());
  add_arrays(arrays, moved->GetPointData(), points.size());
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  write_text_file(path, xml_of(writer.Get(), moved, path));
}

}  // namespace cleft
