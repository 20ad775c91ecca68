#include "explorer/io/mesh_file.h"

#include <vtkCellArray.h>
#include <vtkCleanPolyData.h>
#include <vtkDoubleArray.h>
#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkOBJReader.h>
#include <vtkOBJWriter.h>
#include <vtkPLYReader.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSTLReader.h>
#include <vtkSTLWriter.h>
#include <vtkTriangleFilter.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLPolyDataWriter.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "base/error.h"
#include "base/output_file.h"
#include "base/text.h"
#include "base/vtk_listener.h"
#include "explorer/io/mesh_checks.h"
#include "explorer/io/polygons.h"

namespace cleft {

namespace {

std::string ending_of(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

/// VTK's filters trust the corners that a file names.
void check_corners(const std::string& path, vtkPolyData* data) {
  for (vtkCellArray* cells : {data->GetVerts(), data->GetLines(), data->GetPolys(), data->GetStrips()}) {
    vtkIdType size;
    const vtkIdType* corners;
    for (cells->InitTraversal(); cells->GetNextCell(size, corners);)
      for (vtkIdType i = 0; i < size; ++i)
        if (corners[i] < 0 || corners[i] >= data->GetNumberOfPoints())
          throw FileError(path, "names point " + std::to_string(corners[i]) + "; it has " +
                                    std::to_string(data->GetNumberOfPoints()) + " points");
  }
}

template <class Reader>
vtkSmartPointer<vtkPolyData> read_with(const std::string& path, int& merged) {
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);  // its errors are reported by us
  vtkNew<Reader> reader;
  reader->SetFileName(path.c_str());
  const VtkListener reading(reader.Get());
  reader->Update();
  if (reading.failed()) throw FileError(path, "cannot be read as a mesh: " + reading.reason());
  check_corners(path, reader->GetOutput());
  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputConnection(reader->GetOutputPort());
  triangles->PassLinesOff();
  triangles->PassVertsOff();
  vtkNew<vtkCleanPolyData> clean;  // merges equal points, also of texture seams and STL's loose corners
  clean->SetInputConnection(triangles->GetOutputPort());
  clean->ToleranceIsAbsoluteOn();
  clean->SetAbsoluteTolerance(0);
  clean->Update();
  if (reading.failed()) throw FileError(path, "cannot be read as a mesh: " + reading.reason());
  merged =
      static_cast<int>(triangles->GetOutput()->GetNumberOfPoints() - clean->GetOutput()->GetNumberOfPoints());
  return clean->GetOutput();
}

vtkSmartPointer<vtkPolyData> read_any(const std::string& path, int& merged) {
  const std::string ending = ending_of(path);
  const bool known = ending == ".stl" || ending == ".obj" || ending == ".ply" || ending == ".vtp";
  if (known && !std::ifstream(path)) throw FileError(path, "cannot be opened: does it exist?");
  if (ending == ".ply") check_ply(path);
  if (ending == ".stl") check_stl(path);
  if (ending == ".obj") check_obj(path);
  if (ending == ".stl") return read_with<vtkSTLReader>(path, merged);
  if (ending == ".obj") return read_with<vtkOBJReader>(path, merged);
  if (ending == ".ply") return read_with<vtkPLYReader>(path, merged);
  if (ending == ".vtp") return read_with<vtkXMLPolyDataReader>(path, merged);
  throw InputError(path + ": unknown ending '" + ending + "' of a mesh; known are .stl .obj .ply .vtp");
}

vtkSmartPointer<vtkPolyData> to_vtk(const SurfaceMesh& mesh, const std::vector<PointArray>& arrays) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const Vec3& p : mesh.points) points->InsertNextPoint(p.x, p.y, p.z);
  vtkNew<vtkCellArray> cells;
  for (const auto& t : mesh.triangles) {
    const vtkIdType corners[3] = {t[0], t[1], t[2]};
    cells->InsertNextCell(3, corners);
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetPolys(cells);
  add_arrays(arrays, data->GetPointData(), mesh.points.size());
  return data;
}

template <class Writer>
void write_with(const vtkNew<Writer>& writer, vtkPolyData* data, const std::string& path) {
  OutputFile file(path);
  const VtkListener writing(writer.Get());
  writer->SetFileName(file.path().c_str());
  writer->SetInputData(data);
  if (writer->Write() == 0 || writing.failed())
    throw std::runtime_error(path + ": could not be written: " + writing.reason());
  file.commit();
}

}  // namespace

SurfaceMesh mesh_of_polygons(vtkPolyData* data, const std::string& path, MeshReport* told) {
  MeshReport unread, &report = told ? *told : unread;
  SurfaceMesh mesh;
  std::vector<int> number(data->GetNumberOfPoints(), -1);
  vtkCellArray* cells = data->GetPolys();
  vtkIdType size;
  const vtkIdType* corners;
  for (cells->InitTraversal(); cells->GetNextCell(size, corners);) {
    if (size != 3) continue;
    Vec3 p[3];
    for (int i = 0; i < 3; ++i) {
      data->GetPoint(corners[i], &p[i].x);
      if (!std::isfinite(p[i].x + p[i].y + p[i].z))
        throw FileError(path, "point " + std::to_string(corners[i]) + " is not a number");
    }
    if (norm(cross(p[1] - p[0], p[2] - p[0])) == 0) {
      ++report.degenerate_triangles;
      continue;
    }
    auto& triangle = mesh.triangles.emplace_back();
    for (int i = 0; i < 3; ++i) {
      int& n = number[corners[i]];
      if (n < 0) n = static_cast<int>(mesh.points.size()), mesh.points.push_back(p[i]);
      triangle[i] = n;
    }
  }
  if (mesh.triangles.empty()) throw FileError(path, "has no triangles");
  return repaired(mesh, report);
}

void add_arrays(const std::vector<PointArray>& arrays, vtkPointData* to, std::size_t points) {
  for (const PointArray& array : arrays) {
    CLEFT_CHECK(array.values.size(), ==, points * array.components);
    vtkNew<vtkDoubleArray> values;
    values->SetName(array.name.c_str());
    values->SetNumberOfComponents(array.components);
    values->SetNumberOfTuples(static_cast<vtkIdType>(points));
    std::copy(array.values.begin(), array.values.end(), values->GetPointer(0));
    to->AddArray(values);
  }
}

SurfaceMesh read_mesh(const std::string& path, MeshReport* told) {
  MeshReport report;
  const auto data = read_any(path, report.merged_points);
  SurfaceMesh mesh = mesh_of_polygons(data, path, &report);
  if (told) *told = report;
  return mesh;
}

void check_mesh_ending(const std::string& path) {
  const std::string ending = ending_of(path);
  if (ending != ".vtp" && ending != ".obj" && ending != ".stl")
    throw InputError(path + ": unknown ending '" + ending + "' of a mesh to write; known are .vtp .obj .stl");
}

void write_mesh(const std::string& path, const SurfaceMesh& mesh, const std::vector<PointArray>& arrays) {
  check_mesh_ending(path);
  const std::string ending = ending_of(path);
  if (ending == ".vtp") {
    vtkNew<vtkXMLPolyDataWriter> writer;
    writer->SetDataModeToBinary();  // raw appended data are no XML: ParaView with a strict parser cannot read
                                    // them
    write_with(writer, to_vtk(mesh, arrays), path);
  } else if (ending == ".obj") {
    write_with(vtkNew<vtkOBJWriter>(), to_vtk(mesh, {}), path);
  } else {
    vtkNew<vtkSTLWriter> writer;
    writer->SetFileTypeToBinary();
    write_with(writer, to_vtk(mesh, {}), path);
  }
}

}  // namespace cleft
