#include "encoder/import/decode_series.h"

#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <cmath>
#include <filesystem>
#include <iomanip>
#include <sstream>

#include "base/error.h"
#include "base/output_file.h"
#include "base/text.h"
#include "base/vtk_listener.h"
#include "encoder/import/placement.h"

namespace cleft {

namespace fs = std::filesystem;

namespace {

constexpr const char* at_start = "displacement_at_start";  // what encode calls the displacement of frame 0

FieldSource source_of(const Field& field) {
  if (field.source) return *field.source;
  FieldSource source;
  source.axes = {Vec3{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  return source;
}

/// From (u, v, w) to the source's space: the transposed axes.
Placement back(const FieldSource& source) {
  Placement placement;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) placement.axes[i][k] = source.axes[k][i];
  return placement;
}

/// The name in the source of a field that is called `name` here.
std::string name_there(const FieldSource& source, const std::string& name) {
  for (const std::string& field : source.fields)
    if (const std::size_t colon = field.rfind(':'); field.substr(colon + 1) == name)
      return field.substr(0, colon);
  return name;
}

struct Values {
  std::string name;
  int components;
  std::vector<double> numbers;
};

/// All fields at the nodes, at the time of a frame, in the source's axes.
std::vector<Values> values_at(const KeptField& kept, const FieldSource& source,
                              const std::vector<Place>& nodes, std::size_t frame, double t) {
  const Field& field = *kept.field;
  std::vector<Values> all;
  Values start;
  for (std::size_t q = 0; q < field.quantities.size(); ++q) {
    const Quantity& quantity = field.quantities[q];
    const std::size_t components = static_cast<std::size_t>(quantity.components);
    Values values{quantity.name, quantity.components, std::vector<double>(components * nodes.size())};
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      const std::span<double> at(&values.numbers[components * n], components);
      field.quantity(q, nodes[n].uvw, nodes[n].side, t, at);
      if (q < kept.of_quantities.size() && kept.of_quantities[q])
        for (std::size_t c = 0; c < components; ++c)
          at[c] += kept.of_quantities[q]->at(n, static_cast<int>(c), frame);
    }
    if (values.name == at_start)
      start = std::move(values);
    else
      all.push_back(std::move(values));
  }
  if (field.report.largest_displacement > 0 || !start.numbers.empty() || all.empty()) {
    Values displacement{"displacement", 3, std::vector<double>(3 * nodes.size())};
    std::vector<Place> places = nodes;
    for (Place& place : places) place.t = t;
    std::vector<Vec3> d(places.size());
    field.displacements(places, d);
    for (std::size_t n = 0; n < d.size(); ++n) {
      if (kept.residual) d[n] += kept.residual->at(n, frame);
      for (int c = 0; c < 3; ++c) {
        const std::size_t i = 3 * n + static_cast<std::size_t>(c);
        displacement.numbers[i] = d[n][c] + (start.numbers.empty() ? 0 : start.numbers[i]);
      }
    }
    all.insert(all.begin(), std::move(displacement));
  }
  const Placement to_source = back(source);
  for (Values& values : all) {
    to_source.turn(values.numbers, values.components);
    values.name = name_there(source, values.name);
  }
  return all;
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

void write_frame(vtkUnstructuredGrid* grid, const std::vector<Values>& all, const std::string& path) {
  for (const Values& values : all) {
    vtkNew<vtkDoubleArray> array;
    array->SetName(values.name.c_str());
    array->SetNumberOfComponents(values.components);
    array->SetNumberOfTuples(static_cast<vtkIdType>(values.numbers.size()) / values.components);
    std::copy(values.numbers.begin(), values.numbers.end(), array->GetPointer(0));
    grid->GetPointData()->AddArray(array);
  }
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  const VtkListener writing(writer.Get());
  writer->SetFileName(path.c_str());
  writer->SetInputData(grid);
  writer->SetDataModeToBinary();
  if (writer->Write() == 0 || writing.failed())
    throw FileError(path, "cannot be written: " + writing.reason());
}

double inside(const Field& field, int axis, double value, std::size_t node, double slack) {
  const auto [front, back] = field.domain(axis);
  if (value < front - slack || value > back + slack)
    throw InputError(
        "node " + std::to_string(node) + " is at " + "uvw"[axis] + " = " + shortest(value) +
        " of the field, which reaches from " + shortest(front) + " to " + shortest(back) +
        "; the mesh must lie in the space of the series that the field was made from, within its body");
  return value < front ? front : value > back ? back : value;
}

}  // namespace

DecodeMesh mesh_in_source(SourceMesh mesh, const Field& field) {
  constexpr double at_break = 1e-3;  // of the extent of a node's cells across the break
  const FieldSource source = source_of(field);
  const Placement placement{source.origin, source.axes};
  DecodeMesh result{std::move(mesh), {}};
  for (const Vec3& p : result.mesh.points) {
    const Vec3 placed = placement.placed(p);
    result.nodes.push_back({source.map ? source.map->canonical(placed) : placed});
  }
  const SourceMesh& m = result.mesh;
  std::vector<double> extent(m.points.size(), 0);
  std::vector<std::array<bool, 2>> sides(m.points.size(), {false, false});
  for (std::size_t c = 0; c < m.cell_types.size(); ++c) {
    const std::span corners(m.connectivity.begin() + m.cell_offsets[c],
                            m.connectivity.begin() + m.cell_offsets[c + 1]);
    double sum = 0, farthest = 0;
    for (const std::int64_t n : corners) {
      const double v = result.nodes[n].uvw.y;
      sum += v, farthest = std::max(farthest, std::abs(v));
    }
    if (sum == 0) continue;
    for (const std::int64_t n : corners) {
      extent[n] = std::max(extent[n], farthest);
      sides[n][sum > 0] = true;
    }
  }
  const double slack = same_place(m) * 100;
  for (std::size_t n = 0; n < result.nodes.size(); ++n) {
    Place& place = result.nodes[n];
    if (std::abs(place.uvw.y) <= at_break * extent[n]) {
      place.uvw.y = 0;
      const bool left = sides[n][0], right = sides[n][1];
      place.side = left == right ? Side::both : left ? Side::left : Side::right;
    } else {
      place.side = side_of(place.uvw.y);
    }
    for (int axis = 0; axis < 3; ++axis) place.uvw[axis] = inside(field, axis, place.uvw[axis], n, slack);
  }
  return result;
}

void write_decoded(const KeptField& kept, const DecodeMesh& mesh, const std::string& out,
                   const std::function<void(const std::string&)>& progress) {
  const fs::path pvd = fs::path(out).replace_extension(".pvd"), folder = fs::path(out).replace_extension("");
  for (const fs::path& path : {pvd, folder})
    if (fs::exists(path)) throw InputError(path.string() + " exists: remove it, or give another name");
  const FieldSource source = source_of(*kept.field);
  std::vector<double> times = source.times;
  if (times.empty()) {
    const auto frames = static_cast<int>(std::max(2., kept.field->report.frames));
    for (int j = 0; j < frames; ++j) times.push_back(kept.field->duration() * j / (frames - 1));
  }
  const fs::path temporary = folder.string() + ".incomplete";
  fs::remove_all(temporary);
  fs::create_directories(temporary);
  std::ostringstream list;
  list << "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" "
          "byte_order=\"LittleEndian\">\n<Collection>\n";
  const auto grid = grid_of(mesh.mesh);
  for (std::size_t j = 0; j < times.size(); ++j) {
    progress("writing frame " + std::to_string(j + 1) + " of " + std::to_string(times.size()));
    std::ostringstream name;
    name << "frame_" << std::setw(4) << std::setfill('0') << j << ".vtu";
    write_frame(grid, values_at(kept, source, mesh.nodes, j, times[j] - times.front()),
                temporary / name.str());
    list << "<DataSet timestep=\"" << shortest(times[j]) << "\" part=\"0\" file=\""
         << (folder.filename() / name.str()).string() << "\"/>\n";
  }
  list << "</Collection>\n</VTKFile>\n";
  fs::rename(temporary, folder);
  write_text_file(pvd, list.str());
}

}  // namespace cleft
