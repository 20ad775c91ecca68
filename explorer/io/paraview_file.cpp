#include "explorer/io/paraview_file.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkInformation.h>
#include <vtkInformationStringKey.h>
#include <vtkLogger.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkTypeInt64Array.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <algorithm>
#include <filesystem>
#include <regex>

#include "base/error.h"
#include "base/output_file.h"
#include "base/text.h"
#include "base/vtk_listener.h"

namespace cleft {

namespace fs = std::filesystem;

namespace {

const std::string our_mark = "<!-- written by cleft export";
const std::regex frame_name("frame_[0-9]{4,}\\.vtu");

std::string frame_file(std::size_t frame) {
  const std::string digits = std::to_string(frame);
  return "frame_" + std::string(digits.size() < 4 ? 4 - digits.size() : 0, '0') + digits + ".vtu";
}

template <class Array, class T>
vtkNew<Array> array_of(const std::vector<T>& values) {
  vtkNew<Array> array;
  array->SetNumberOfValues(static_cast<vtkIdType>(values.size()));
  std::copy(values.begin(), values.end(), array->GetPointer(0));
  return array;
}

vtkNew<vtkDoubleArray> numbers(const std::string& name, int components, const std::vector<double>& values,
                               const Units& units = {}) {
  vtkNew<vtkDoubleArray> array;
  if (const std::string unit = units ? units(name) : ""; !unit.empty())
    array->GetInformation()->Set(vtkDataArray::UNITS_LABEL(), unit.c_str());
  array->SetName(name.c_str());
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(static_cast<vtkIdType>(values.size()) / components);
  std::copy(values.begin(), values.end(), array->GetPointer(0));
  return array;
}

std::vector<double> flat(const std::vector<Vec3>& vectors) {
  std::vector<double> values;
  values.reserve(3 * vectors.size());
  for (const Vec3& v : vectors) values.insert(values.end(), {v.x, v.y, v.z});
  return values;
}

/// The mesh in its stress-free shape, without arrays on points.
vtkNew<vtkUnstructuredGrid> mesh_of(const Snapshot& s) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetData(numbers("Points", 3, flat(s.points)));
  vtkNew<vtkCellArray> cells;
  cells->SetData(array_of<vtkTypeInt64Array>(s.cell_offsets), array_of<vtkTypeInt64Array>(s.connectivity));
  std::vector<std::uint8_t> parts;
  for (const std::uint8_t type : s.cell_types) parts.push_back(type == Snapshot::triangle ? 0 : 1);
  const auto part = array_of<vtkUnsignedCharArray>(parts);
  part->SetName("part");
  vtkNew<vtkUnstructuredGrid> grid;
  grid->SetPoints(points);
  grid->SetCells(array_of<vtkUnsignedCharArray>(s.cell_types), cells);
  grid->GetCellData()->AddArray(part);
  return grid;
}

/// The text of a .vtu file.
std::string vtu(vtkUnstructuredGrid* grid) {
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);  // its errors are reported by us
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->SetHeaderTypeToUInt64();
  writer->SetCompressorTypeToZLib();
  return xml_of(writer.Get(), grid, "a frame as .vtu");
}

std::string xml(const std::string& text) {
  std::string escaped;
  for (const char c : text) switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      default:
        escaped += c;
    }
  return escaped;
}

std::string collection(const std::vector<double>& times, const std::string& name) {
  std::string text = "<?xml version=\"1.0\"?>\n" + our_mark + " (" + producer() +
                     ") -->\n<VTKFile type=\"Collection\" version=\"0.1\">\n  <Collection>\n";
  for (std::size_t j = 0; j < times.size(); ++j)
    text += "    <DataSet timestep=\"" + shortest(times[j]) + "\" group=\"\" part=\"0\" file=\"" +
            xml(name + "/" + frame_file(j)) + "\"/>\n";
  return text + "  </Collection>\n</VTKFile>\n";
}

bool is_our_collection(const fs::path& path) {
  return fs::is_regular_file(fs::symlink_status(path)) &&
         read_text_file(path.string()).substr(0, 100).find(our_mark) != std::string::npos;
}

bool holds_only_frames(const fs::path& folder) {
  return fs::is_directory(fs::symlink_status(folder)) &&
         std::all_of(fs::directory_iterator(folder), {}, [](const fs::directory_entry& entry) {
           return entry.is_regular_file() && std::regex_match(entry.path().filename().string(), frame_name);
         });
}

[[noreturn]] void refuse(const fs::path& path, const std::string& what) {
  throw InputError(path.lexically_normal().string() + ": exists and " + what +
                   "; give another name, or remove it");
}

/// A file a frame and the .pvd of all. `take(j)` puts frame j's arrays into the grid.
ExportFigures write_frames(vtkUnstructuredGrid* grid, const std::vector<double>& times,
                           const std::string& folder, const std::string& name,
                           const std::function<void(std::size_t)>& take) {
  const fs::path frames = fs::path(folder) / name;
  fs::create_directory(frames);
  ExportFigures figures;
  const auto write = [&](const std::string& path, const std::string& text) {
    write_text_file(path, text);
    ++figures.files, figures.bytes += fs::file_size(path);
  };
  for (std::size_t j = 0; j < times.size(); ++j, ++figures.frames) {
    take(j);
    grid->GetPointData()->SetActiveVectors("displacement");
    grid->GetFieldData()->AddArray(numbers("TimeValue", 1, {times[j]}));
    write((frames / frame_file(j)).string(), vtu(grid));
  }
  write(frames.string() + ".pvd", collection(times, name));
  return figures;
}

}  // namespace

ExportFigures& ExportFigures::operator+=(const ExportFigures& other) {
  files += other.files, frames += other.frames, bytes += other.bytes;
  return *this;
}

ExportFigures write_paraview_series(const SnapshotReader& reader, const std::string& folder,
                                    const std::string& name, const Units& units,
                                    const std::function<void(std::size_t)>& progress) {
  const Snapshot& s = reader.snapshot();
  const std::vector<SnapshotArray> arrays = reader.point_arrays();
  const vtkNew<vtkUnstructuredGrid> grid = mesh_of(s);
  const auto add = [&](const SnapshotArray& array, const std::vector<double>& values) {
    grid->GetPointData()->AddArray(numbers(array.name, static_cast<int>(array.components), values, units));
  };
  return write_frames(grid, s.times, folder, name, [&](std::size_t j) {
    if (progress) progress(j);
    add({"displacement", 3, true}, flat(reader.displacement(j)));
    for (const SnapshotArray& array : arrays)
      if (array.varies || j == 0) add(array, reader.point_array(array, j));
  });
}

namespace {

vtkNew<vtkUnstructuredGrid> mesh_of(const SurfaceSeries& series) {
  Snapshot s;
  s.points = series.points;
  s.cell_types.assign(series.triangles.size(), Snapshot::triangle);
  s.cell_offsets.push_back(0);
  for (const auto& triangle : series.triangles) {
    s.connectivity.insert(s.connectivity.end(), triangle.begin(), triangle.end());
    s.cell_offsets.push_back(static_cast<std::int64_t>(s.connectivity.size()));
  }
  vtkNew<vtkUnstructuredGrid> grid = mesh_of(s);
  const auto part = array_of<vtkUnsignedCharArray>(series.parts);
  part->SetName("part");
  grid->GetCellData()->AddArray(part);
  return grid;
}

}  // namespace

ExportFigures write_paraview_series(const SurfaceSeries& series, const std::string& folder,
                                    const std::string& name) {
  const auto grid = mesh_of(series);
  return write_frames(grid, series.times, folder, name, [&](std::size_t j) {
    grid->GetPointData()->AddArray(
        numbers("displacement", 3, flat(series.displacement(series.times[j])), series.units));
  });
}

ExportFigures write_paraview_series(const MeshSeries& series, const std::string& folder,
                                    const std::string& name,
                                    const std::function<void(std::size_t)>& progress) {
  const vtkNew<vtkUnstructuredGrid> grid = mesh_of(*series.mesh);
  return write_frames(grid, series.times, folder, name, [&](std::size_t j) {
    if (progress) progress(j);
    const double t = series.times[j];
    grid->GetPointData()->AddArray(numbers("displacement", 3, flat(series.displacement(t)), series.units));
    for (std::size_t a = 0; a < series.arrays.size(); ++a)
      grid->GetPointData()->AddArray(numbers(series.arrays[a].name,
                                             static_cast<int>(series.arrays[a].components),
                                             series.values(a, t), series.units));
  });
}

void refuse_to_replace_series(const std::string& folder, const std::string& name) {
  const fs::path frames = fs::path(folder) / name, pvd = frames.string() + ".pvd";
  const bool exported = fs::exists(fs::symlink_status(pvd));
  if (exported && !is_our_collection(pvd)) refuse(pvd, "was not written by cleft export");
  if (!fs::exists(fs::symlink_status(frames))) return;
  if (!holds_only_frames(frames)) refuse(frames, "is not a folder of frames written by cleft export");
  if (!exported && !fs::is_empty(frames))
    refuse(frames, "holds files, without " + pvd.filename().string() + " beside it");
}

void refuse_to_replace_folder_of_series(const std::string& folder) {
  if (!fs::exists(fs::symlink_status(folder))) return;
  if (!fs::is_directory(fs::symlink_status(folder))) refuse(folder, "is not a folder");
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const fs::path name = entry.path().filename();
    refuse_to_replace_series(folder, (name.extension() == ".pvd" ? name.stem() : name).string());
  }
}

}  // namespace cleft
