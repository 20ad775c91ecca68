#include "explorer/io/cells_file.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkIdList.h>
#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <cmath>
#include <filesystem>

#include "base/error.h"
#include "base/vtk_listener.h"

namespace cleft {

namespace {

constexpr const char* usual_names[] = {"region", "gmsh:physical", "CellEntityIds", "medit:ref",
                                       "MaterialIDs"};

std::string names_of(vtkFieldData* data) {
  std::string names;
  for (int a = 0; a < data->GetNumberOfArrays(); ++a)
    names += (a > 0 ? ", " : "") + std::string(data->GetArrayName(a) ? data->GetArrayName(a) : "");
  return names.empty() ? "none" : names;
}

/// The array of this name, of one number each; null if there is none.
vtkDataArray* array_of(vtkFieldData* data, const std::string& name) {
  vtkDataArray* array = data->GetArray(name.c_str());
  return array && array->GetNumberOfComponents() == 1 ? array : nullptr;
}

vtkDataArray* named(const std::string& path, vtkFieldData* data, const std::string& name, const char* of) {
  vtkDataArray* array = array_of(data, name);
  if (!array)
    throw FileError(path, "has no array '" + name + "' of one number for each " + of +
                              "; its arrays are: " + names_of(data));
  return array;
}

std::vector<int> whole_numbers(const std::string& path, vtkDataArray* array, const std::string& name) {
  std::vector<int> numbers;
  for (vtkIdType c = 0; c < array->GetNumberOfTuples(); ++c) {
    const double value = array->GetTuple1(c);
    if (!(std::abs(value) <= 1e9) || value != std::floor(value))
      throw FileError(path,
                      "array '" + name + "', cell " + std::to_string(c) + ": a region is a whole number");
    numbers.push_back(static_cast<int>(value));
  }
  return numbers;
}

}  // namespace

FileCells read_cells(const std::string& path, const std::optional<std::string>& regions,
                     const std::optional<std::string>& release) {
  if (!std::filesystem::is_regular_file(path)) throw FileError(path, "does not exist or is not a file");
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(path.c_str());
  const VtkListener reading(reader.Get());
  reader->Update();
  if (reading.failed()) throw FileError(path, "cannot be read as a mesh of cells: " + reading.reason());
  vtkUnstructuredGrid* grid = reader->GetOutput();
  FileCells result;
  result.points.resize(static_cast<std::size_t>(grid->GetNumberOfPoints()));
  for (std::size_t i = 0; i < result.points.size(); ++i)
    grid->GetPoint(static_cast<vtkIdType>(i), &result.points[i].x);
  vtkNew<vtkIdList> list;
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c) {
    grid->GetCellPoints(c, list);
    result.types.push_back(grid->GetCellType(c));
    std::vector<int>& nodes = result.nodes.emplace_back(list->begin(), list->end());
    for (const int n : nodes)
      if (n < 0 || n >= static_cast<int>(result.points.size()))
        throw FileError(path, "cell " + std::to_string(c) + " names point " + std::to_string(n) +
                                  "; it has " + std::to_string(result.points.size()) + " points");
  }
  vtkFieldData* of_cells = grid->GetCellData();
  vtkDataArray* numbers = regions ? named(path, of_cells, *regions, "cell") : nullptr;
  if (regions) result.regions_name = *regions;
  for (const char* name : usual_names)
    if (!regions && !numbers && (numbers = array_of(of_cells, name))) result.regions_name = name;
  if (numbers) result.regions = whole_numbers(path, numbers, result.regions_name);
  if (release) {
    vtkDataArray* values = named(path, grid->GetPointData(), *release, "point");
    for (vtkIdType n = 0; n < values->GetNumberOfTuples(); ++n)
      result.release.push_back(values->GetTuple1(n));
  }
  return result;
}

}  // namespace cleft
