#include "encoder/import/decode_series.h"

#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iomanip>
#include <sstream>

#include "base/error.h"
#include "base/output_file.h"
#include "base/output_folder.h"
#include "base/parallel.h"
#include "base/text.h"
#include "base/vtk_listener.h"
#include "encoder/field/at_time.h"
#include "encoder/field/quantity_fields.h"
#include "encoder/import/decoded_vtkhdf.h"
#include "encoder/import/vtk_frames.h"

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

/// The name in the source of a field that is called `name` here.
std::string name_there(const FieldSource& source, const std::string& name) {
  for (const std::string& field : source.fields)
    if (const SourceName one(field); one.here == name) return one.there;
  return name;
}

struct Values {
  std::string name;
  int components;
  std::vector<double> numbers;
};

/// All fields at the nodes, at the time of a frame, in the source's axes.
std::vector<Values> values_at(const DecodedNodes& decoded, const FieldSource& source, std::size_t frame,
                              double t) {
  const Field& field = *decoded.first;
  std::vector<Values> all;
  Values start;
  for (std::size_t q = 0; q < field.quantities.size(); ++q) {
    Values values{field.quantities[q].name, field.quantities[q].components, decoded.quantity(q, t, frame)};
    if (values.name == at_start)
      start = std::move(values);
    else
      all.push_back(std::move(values));
  }
  if (field.report.largest_displacement > 0 || !start.numbers.empty() || all.empty()) {
    Values displacement{"displacement", 3, {}};
    const std::vector<Vec3> d = decoded.displacement(t, frame);
    displacement.numbers.reserve(3 * d.size());
    for (std::size_t n = 0; n < d.size(); ++n)
      for (int c = 0; c < 3; ++c) {
        const std::size_t i = 3 * n + static_cast<std::size_t>(c);
        displacement.numbers.push_back(d[n][c] + (start.numbers.empty() ? 0 : start.numbers[i]));
      }
    all.insert(all.begin(), std::move(displacement));
  }
  const AxesInSpace to_source = axes_between(source.axes, same_axes);
  for (Values& values : all) {
    turn(values.numbers, values.components, to_source);
    values.name = name_there(source, values.name);
  }
  return all;
}

/// The mesh once, and every frame's values beside each other.
void write_vtkhdf(const DecodedNodes& decoded, const SourceMesh& mesh, const FieldSource& source,
                  const std::vector<double>& times, const std::string& out,
                  const std::function<void(const std::string&)>& progress) {
  OutputFile file(out);
  DecodedVtkHdf series(file.path(), mesh, times);
  for (std::size_t j = 0; j < times.size(); ++j) {
    progress("writing frame " + std::to_string(j + 1) + " of " + std::to_string(times.size()));
    for (const Values& values : values_at(decoded, source, j, times[j] - times.front()))
      series.write(j, values.name, values.components, values.numbers);
  }
  series.close();
  file.commit();
}

/// Times of the frames, in the source.
std::vector<double> times_of(const Field& field, const FieldSource& source) {
  if (!source.times.empty()) return source.times;
  std::vector<double> times;
  const auto frames = static_cast<int>(std::max(2., field.report.frames));
  times.reserve(static_cast<std::size_t>(frames));
  for (int j = 0; j < frames; ++j) times.push_back(field.duration() * j / (frames - 1));
  return times;
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
  writer->SetCompressionLevel(1);  // most of the time is the compressor's
  write_text_file(path, xml_of(writer.Get(), grid, path));
}

/// Calls work(first, last) for ranges of so many nodes, on all cores.
template <class Work>
void in_ranges(std::size_t nodes, const Work& work) {
  constexpr std::size_t at_once = 1 << 16;
  parallel_for(static_cast<int>((nodes + at_once - 1) / at_once), [&](int range) {
    const std::size_t first = static_cast<std::size_t>(range) * at_once;
    work(first, std::min(nodes, first + at_once));
  });
}

double clamped(const Field& field, int axis, double value) {
  const auto [front, back] = field.domain(axis);
  return value < front ? front : value > back ? back : value;
}

double inside(const Field& field, int axis, double value, std::size_t node, double slack) {
  const auto [front, back] = field.domain(axis);
  if (value < front - slack || value > back + slack)
    throw InputError(
        "node " + std::to_string(node) + " is at " + "uvw"[axis] + " = " + shortest(value) +
        " of the field, which reaches from " + shortest(front) + " to " + shortest(back) +
        "; the mesh must lie in the space of the series that the field was made from, within its body");
  return clamped(field, axis, value);
}

}  // namespace

std::vector<Place> nodes_in_field(const SourceMesh& m, const Field& field, const std::vector<char>* asked) {
  constexpr double at_break = 1e-3;  // of the extent of a node's cells across the break
  const FieldSource source = source_of(field);
  std::vector<Place> nodes;
  nodes.reserve(m.points.size());
  for (const Vec3& p : m.points) nodes.push_back({source.canonical(p)});
  std::vector<double> extent(m.points.size(), 0);
  std::vector<std::array<bool, 2>> sides(m.points.size(), {false, false});
  for (std::size_t c = 0; c < m.cell_types.size(); ++c) {
    const std::span corners(m.connectivity.begin() + m.cell_offsets[c],
                            m.connectivity.begin() + m.cell_offsets[c + 1]);
    double sum = 0, farthest = 0;
    for (const std::int64_t n : corners) {
      const double v = nodes[n].uvw.y;
      sum += v, farthest = std::max(farthest, std::abs(v));
    }
    if (sum == 0) continue;
    for (const std::int64_t n : corners) {
      extent[n] = std::max(extent[n], farthest);
      sides[n][sum > 0] = true;
    }
  }
  const double slack = same_place(m) * 100;
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    Place& place = nodes[n];
    if (std::abs(place.uvw.y) <= at_break * extent[n]) {
      place.uvw.y = 0;
      const bool left = sides[n][0], right = sides[n][1];
      place.side = left == right ? Side::both : left ? Side::left : Side::right;
    } else {
      place.side = side_of(place.uvw.y);
    }
    const bool strict = !asked || (*asked)[n];
    for (int axis = 0; axis < 3; ++axis)
      place.uvw[axis] =
          strict ? inside(field, axis, place.uvw[axis], n, slack) : clamped(field, axis, place.uvw[axis]);
  }
  return nodes;
}

std::vector<NodesOfPiece> nodes_in_pieces(const SourceMesh& mesh, const BlendedField& field) {
  const std::vector<Vec3> inside_cells =
      places_inside_cells(mesh.points, mesh.cell_offsets, mesh.connectivity);
  std::vector<std::vector<double>> weights(mesh.points.size(), std::vector<double>(field.pieces().size()));
  for (std::size_t n = 0; n < weights.size(); ++n) field.weights(inside_cells[n], weights[n]);
  std::vector<NodesOfPiece> pieces;
  for (std::size_t p = 0; p < field.pieces().size(); ++p) {
    std::vector<char> mostly(weights.size());
    for (std::size_t n = 0; n < weights.size(); ++n) mostly[n] = weights[n][p] >= 0.5;
    const std::vector<Place> places = nodes_in_field(mesh, field.pieces()[p], &mostly);
    auto& piece = pieces.emplace_back();
    for (std::size_t n = 0; n < weights.size(); ++n)
      if (weights[n][p] > 0)
        piece.nodes.push_back(static_cast<std::int32_t>(n)), piece.places.push_back(places[n]);
  }
  return pieces;
}

DecodedNodes decoded_at(const KeptField& kept, const std::vector<Place>& nodes) {
  const auto places_at = [&nodes](std::size_t first, std::size_t last, double t) {
    return at_time(std::span(nodes).subspan(first, last - first), t);
  };
  const auto displacement = [&, places_at](double t, std::size_t frame) {
    std::vector<Vec3> d(nodes.size());
    in_ranges(nodes.size(), [&](std::size_t first, std::size_t last) {
      kept.field->displacements(places_at(first, last, t), std::span(d).subspan(first, last - first));
      for (std::size_t n = first; kept.residual && n < last; ++n) d[n] += kept.residual->at(n, frame);
    });
    return d;
  };
  const auto quantity = [&, places_at](std::size_t q, double t, std::size_t frame) {
    const QuantityFields fields(*kept.field, q);
    const std::size_t components = fields.components();
    const bool has = q < kept.of_quantities.size() && kept.of_quantities[q];
    std::vector<double> numbers(components * nodes.size());
    in_ranges(nodes.size(), [&](std::size_t first, std::size_t last) {
      fields.at(places_at(first, last, t),
                std::span(numbers).subspan(components * first, components * (last - first)));
      for (std::size_t n = first; has && n < last; ++n)
        for (std::size_t c = 0; c < components; ++c)
          numbers[components * n + c] += kept.of_quantities[q]->at(n, static_cast<int>(c), frame);
    });
    return numbers;
  };
  return {kept.field, displacement, quantity};
}

DecodedNodes decoded_at(const PiecesAtNodes& pieces) {
  return {&pieces.field().first(), [&](double t, std::size_t frame) { return pieces.displacement(t, frame); },
          [&](std::size_t q, double t, std::size_t frame) { return pieces.quantity(q, t, frame); }};
}

void write_decoded(const DecodedNodes& decoded, const SourceMesh& mesh, const std::string& out,
                   const std::function<void(const std::string&)>& progress) {
  const FieldSource source = source_of(*decoded.first);
  const std::vector<double> times = times_of(*decoded.first, source);
  const bool one_file = fs::path(out).extension() == ".vtkhdf";
  const fs::path pvd = fs::path(out).replace_extension(".pvd"), folder = fs::path(out).replace_extension("");
  for (const fs::path& path : one_file ? std::vector<fs::path>{out} : std::vector<fs::path>{pvd, folder})
    if (fs::exists(path)) throw InputError(path.string() + " exists: remove it, or give another name");
  if (one_file) return write_vtkhdf(decoded, mesh, source, times, out, progress);
  const std::string name = folder.filename().string();
  OutputFolder place(folder.has_parent_path() ? folder.parent_path().string() : ".", name);
  const fs::path frames = fs::path(place.path()) / name;
  fs::create_directory(frames);
  std::ostringstream list;
  list << "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" "
          "byte_order=\"LittleEndian\">\n<Collection>\n";
  const auto grid = grid_of(mesh);
  for (std::size_t j = 0; j < times.size(); ++j) {
    progress("writing frame " + std::to_string(j + 1) + " of " + std::to_string(times.size()));
    std::ostringstream frame;
    frame << "frame_" << std::setw(4) << std::setfill('0') << j << ".vtu";
    write_frame(grid, values_at(decoded, source, j, times[j] - times.front()), frames / frame.str());
    list << "<DataSet timestep=\"" << shortest(times[j]) << "\" part=\"0\" file=\""
         << (folder.filename() / frame.str()).string() << "\"/>\n";
  }
  list << "</Collection>\n</VTKFile>\n";
  write_text_file((fs::path(place.path()) / pvd.filename()).string(), list.str());
  place.commit({name, pvd.filename().string()});
}

}  // namespace cleft
