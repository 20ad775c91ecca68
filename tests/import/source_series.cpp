#include "tests/import/source_series.h"

#include <algorithm>
#include <limits>
#include <map>
#include <sstream>

#include "base/text.h"

namespace cleft {

namespace {

template <class T>
std::string data_array(const std::string& type, const std::string& name, int components,
                       const std::vector<T>& values) {
  std::ostringstream text;
  text << "<DataArray type=\"" << type << "\" Name=\"" << name << "\" NumberOfComponents=\"" << components
       << "\" format=\"ascii\">";
  for (const T value : values)
    if constexpr (std::is_integral_v<T>)
      text << +value << ' ';
    else
      text << shortest(value) << ' ';
  text << "</DataArray>\n";
  return text.str();
}

std::string written(const TemporaryFolder& folder, const ImportOptions& options, ImportReport& report) {
  report = import_series(options, [](const std::string&) {});
  check_snapshot(folder / "case.h5");
  return folder / "case.h5";
}

}  // namespace

std::int32_t SourceSeries::add_point(const Vec3& p) {
  mesh.points.push_back(p);
  return static_cast<std::int32_t>(mesh.points.size()) - 1;
}

void SourceSeries::add_cell(std::uint8_t type, const std::vector<std::int64_t>& corners) {
  if (mesh.cell_offsets.empty()) mesh.cell_offsets = {0};
  mesh.cell_types.push_back(type);
  mesh.connectivity.insert(mesh.connectivity.end(), corners.begin(), corners.end());
  mesh.cell_offsets.push_back(static_cast<std::int64_t>(mesh.connectivity.size()));
}

std::string SourceSeries::vtu(std::size_t frame) const {
  std::vector<double> places;
  for (const Vec3& p : mesh.points) places.insert(places.end(), {p.x, p.y, p.z});
  std::ostringstream text;
  text << "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" "
          "byte_order=\"LittleEndian\">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\""
       << mesh.points.size() << "\" NumberOfCells=\"" << mesh.cell_types.size() << "\">\n";
  for (const bool of_cells : {false, true}) {
    const std::string element = of_cells ? "CellData>\n" : "PointData>\n";
    if (of_cells && std::none_of(fields.begin(), fields.end(), [](const Field& f) { return f.of_cells; }))
      continue;
    text << "<" << element;
    for (const Field& field : fields)
      if (field.of_cells == of_cells)
        text << data_array(single ? "Float32" : "Float64", field.name, field.components, field.frames[frame]);
    text << "</" << element;
  }
  text << "<Points>\n"
       << data_array("Float64", "Points", 3, places) << "</Points>\n<Cells>\n"
       << data_array("Int64", "connectivity", 1, mesh.connectivity)
       << data_array("Int64", "offsets", 1,
                     std::vector<std::int64_t>(mesh.cell_offsets.begin() + 1, mesh.cell_offsets.end()))
       << data_array("UInt8", "types", 1, mesh.cell_types)
       << "</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
  return text.str();
}

std::string SourceSeries::write(const TemporaryFolder& folder, const std::string& name) const {
  std::string list = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n";
  for (std::size_t j = 0; j < times.size(); ++j) {
    const std::string file = name + "_" + std::to_string(j) + ".vtu";
    folder.write(file, vtu(j));
    list += "<DataSet timestep=\"" + shortest(times[j]) + "\" part=\"0\" file=\"" + file + "\"/>\n";
  }
  return folder.write(name + ".pvd", list + "</Collection>\n</VTKFile>\n");
}

SourceSeries skin_of(SourceSeries series) {
  constexpr int faces[6][4] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                               {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
  std::map<std::vector<std::int64_t>, std::vector<std::vector<std::int64_t>>> by_corners;
  for (std::size_t c = 0; c < series.mesh.cell_types.size(); ++c)
    for (const auto& face : faces) {
      std::vector<std::int64_t> corners, sorted;
      for (const int k : face)
        corners.push_back(series.mesh.connectivity[8 * c + static_cast<std::size_t>(k)]);
      sorted = corners;
      std::sort(sorted.begin(), sorted.end());
      by_corners[sorted].push_back(corners);
    }
  series.mesh.cell_types.clear(), series.mesh.cell_offsets.clear(), series.mesh.connectivity.clear();
  for (const auto& [sorted, all] : by_corners)
    if (all.size() == 1) series.add_cell(quad, all.front());
  return series;
}

Pose Pose::random(unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  const auto vector = [&] { return Vec3{normal(random), normal(random), normal(random)}; };
  Pose pose;
  pose.axes[0] = normalized(vector());
  pose.axes[1] = normalized(cross(pose.axes[0], vector()));
  pose.axes[2] = cross(pose.axes[0], pose.axes[1]);
  pose.origin = 20.0 * vector();
  return pose;
}

std::vector<double> Pose::tensor(const std::vector<double>& t) const {
  const double local[3][3] = {{t[0], t[3], t[5]}, {t[3], t[1], t[4]}, {t[5], t[4], t[2]}};
  const auto component = [&](int i, int j) {
    double sum = 0;
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b) sum += axes[a][i] * local[a][b] * axes[b][j];
    return sum;
  };
  return {component(0, 0), component(1, 1), component(2, 2),
          component(0, 1), component(1, 2), component(0, 2)};
}

Imported::Imported(const TemporaryFolder& folder, const std::string& series,
                   const std::vector<std::string>& fields, const std::optional<std::string>& break_plane,
                   Box box)
    : reader(written(folder, {series, folder / "case.h5", fields, break_plane, box}, report)) {}

std::string Imported::notes() const {
  std::string text;
  for (const std::string& note : report.notes) text += note + "\n";
  return text;
}

double largest_difference(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  if (a.size() != b.size()) return std::numeric_limits<double>::infinity();
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, norm(a[i] - b[i]));
  return largest;
}

}  // namespace cleft
