#include "explorer/io/mesh_file.h"

#include <vtkCellArray.h>
#include <vtkCleanPolyData.h>
#include <vtkDoubleArray.h>
#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkTriangleFilter.h>
#include <vtkUnsignedCharArray.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLPolyDataWriter.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "base/error.h"
#include "base/output_file.h"
#include "base/text.h"
#include "base/vtk_listener.h"
#include "explorer/io/formats/mesh_formats.h"
#include "explorer/io/gltf_file.h"
#include "explorer/io/mesh_polygons.h"
#include "explorer/io/obj_file.h"
#include "explorer/io/ply_file.h"
#include "explorer/io/polygons.h"
#include "explorer/io/stl_file.h"

namespace cleft {

namespace {

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

/// Triangles of polygons, with points at the same place merged: of texture seams, and of .stl's loose
/// corners.
vtkSmartPointer<vtkPolyData> merged_triangles(vtkPolyData* polygons, int& merged) {
  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputData(polygons);
  triangles->PassLinesOff();
  triangles->PassVertsOff();
  vtkNew<vtkCleanPolyData> clean;
  clean->SetInputConnection(triangles->GetOutputPort());
  clean->ToleranceIsAbsoluteOn();
  clean->SetAbsoluteTolerance(0);
  clean->Update();
  merged =
      static_cast<int>(triangles->GetOutput()->GetNumberOfPoints() - clean->GetOutput()->GetNumberOfPoints());
  return clean->GetOutput();
}

/// What a reader has to tell besides its triangles.
struct Told {
  int merged_points = 0;
  std::string note = {};
};

vtkSmartPointer<vtkPolyData> read_vtp(const std::string& path, Told& told) {
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);  // its errors are reported by us
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(path.c_str());
  const VtkListener reading(reader.Get());
  reader->Update();
  if (reading.failed()) throw FileError(path, "cannot be read as a mesh: " + reading.reason());
  check_corners(path, reader->GetOutput());
  return merged_triangles(reader->GetOutput(), told.merged_points);
}

constexpr const char* color_name = "RGB";

/// Bytes, as ParaView takes them for colours.
vtkSmartPointer<vtkUnsignedCharArray> color_array(const std::vector<PointColor>& colors) {
  auto array = vtkSmartPointer<vtkUnsignedCharArray>::New();
  array->SetName(color_name);
  array->SetNumberOfComponents(3);
  array->SetNumberOfTuples(static_cast<vtkIdType>(colors.size()));
  unsigned char* to = array->GetPointer(0);
  for (const PointColor& color : colors)
    for (const std::uint8_t part : byte_color(color)) *to++ = part;
  return array;
}

/// The colours of points: bytes that are called RGB or RGBA, or are what the data are coloured by. Null:
/// there are none.
vtkUnsignedCharArray* colors_of(vtkPointData* of) {
  for (vtkDataArray* array : {of->GetArray(color_name), of->GetArray("RGBA"), of->GetScalars()}) {
    const auto bytes = vtkUnsignedCharArray::SafeDownCast(array);
    if (bytes && (bytes->GetNumberOfComponents() == 3 || bytes->GetNumberOfComponents() == 4)) return bytes;
  }
  return nullptr;
}

PointColor color_at(const vtkUnsignedCharArray& colors, vtkIdType point) {
  PointColor color;
  for (int k = 0; k < 3; ++k) color[static_cast<std::size_t>(k)] = colors.GetTypedComponent(point, k) / 255.F;
  return color;
}

template <MeshPolygons (*read)(const std::string& path)>
vtkSmartPointer<vtkPolyData> read_own(const std::string& path, Told& told) {
  const MeshPolygons mesh = read(path);
  told.note = mesh.note;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const Vec3& p : mesh.points) points->InsertNextPoint(p.x, p.y, p.z);
  vtkNew<vtkCellArray> cells;
  for (const std::vector<int>& polygon : mesh.polygons) {
    if (polygon.size() < 3) continue;
    cells->InsertNextCell(static_cast<int>(polygon.size()));
    for (const int corner : polygon) cells->InsertCellPoint(corner);
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetPolys(cells);
  if (!mesh.colors.empty()) data->GetPointData()->AddArray(color_array(mesh.colors));
  return merged_triangles(data, told.merged_points);
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
  if (!mesh.colors.empty()) {
    CLEFT_CHECK(mesh.colors.size(), ==, mesh.points.size());
    data->GetPointData()->AddArray(color_array(mesh.colors));
  }
  return data;
}

void write_stl(const std::string& path, const SurfaceMesh& mesh, const std::vector<PointArray>&) {
  write_text_file(path, stl_of(mesh, path));
}

void write_obj(const std::string& path, const SurfaceMesh& mesh, const std::vector<PointArray>&) {
  write_text_file(path, obj_of(mesh));
}

void write_vtp(const std::string& path, const SurfaceMesh& mesh, const std::vector<PointArray>& arrays) {
  vtkNew<vtkXMLPolyDataWriter> writer;
  write_text_file(path, xml_of(writer.Get(), to_vtk(mesh, arrays), path));
}

void write_ply(const std::string& path, const SurfaceMesh& mesh, const std::vector<PointArray>&) {
  write_text_file(path, ply_of(mesh));
}

/// What reads and writes a row of the table of formats.
struct SurfaceFile {
  std::string_view ending;
  vtkSmartPointer<vtkPolyData> (*read)(const std::string& path, Told& told);
  void (*write)(const std::string& path, const SurfaceMesh& mesh, const std::vector<PointArray>& arrays);
};

constexpr SurfaceFile surface_files[] = {
    {".stl", read_own<read_stl>, write_stl}, {".obj", read_own<read_obj>, write_obj},
    {".ply", read_own<read_ply>, write_ply}, {".vtp", read_vtp, write_vtp},
    {".glb", read_own<read_gltf>, nullptr},  {".gltf", read_own<read_gltf>, nullptr},
};

constexpr const SurfaceFile* file_of(std::string_view ending) {
  for (const SurfaceFile& file : surface_files)
    if (file.ending == ending) return &file;
  return nullptr;
}

[[maybe_unused]] constexpr bool every_surface_has_its_files() {
  std::size_t surfaces = 0;
  for (const MeshFormat& format : mesh_formats) {
    if (format.kind != MeshKind::surface) continue;
    const SurfaceFile* file = file_of(format.ending);
    if (!file || !file->read || (file->write != nullptr) != format.written) return false;
    ++surfaces;
  }
  return surfaces == std::size(surface_files);
}
#ifndef __SANITIZE_ADDRESS__  // whose build takes no address of a function for a constant
static_assert(every_surface_has_its_files(), "a surface of mesh_formats.h lacks its row in surface_files");
#endif

}  // namespace

SurfaceMesh mesh_of_polygons(vtkPolyData* data, const std::string& path, MeshReport* told) {
  MeshReport unread, &report = told ? *told : unread;
  SurfaceMesh mesh;
  std::vector<int> number(data->GetNumberOfPoints(), -1);
  const vtkUnsignedCharArray* colors = colors_of(data->GetPointData());
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
      if (n < 0) {
        n = static_cast<int>(mesh.points.size()), mesh.points.push_back(p[i]);
        if (colors) mesh.colors.push_back(color_at(*colors, corners[i]));
      }
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
  const SurfaceFile& file = *file_of(surface_format(path, MeshUse::read).ending);
  if (!std::ifstream(path)) throw FileError(path, "cannot be opened: does it exist?");
  MeshReport report;
  Told found;
  const auto data = file.read(path, found);
  report.merged_points = found.merged_points;
  SurfaceMesh mesh = mesh_of_polygons(data, path, &report);
  mesh.note = found.note;
  if (told) *told = report;
  return mesh;
}

void write_mesh(const std::string& path, const SurfaceMesh& mesh, const std::vector<PointArray>& arrays) {
  file_of(surface_format(path, MeshUse::write).ending)->write(path, mesh, arrays);
}

}  // namespace cleft
