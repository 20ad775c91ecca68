#include "base/h5/vtkhdf.h"

#include <algorithm>
#include <array>

namespace cleft::h5 {

void write_vtk_mesh(File& file, std::span<const double> points, const std::vector<std::uint8_t>& types,
                    const std::vector<std::int64_t>& offsets, const std::vector<std::int64_t>& connectivity) {
  file.create_group("/VTKHDF");
  file.write_integers("/VTKHDF", "Version", std::array<std::int64_t, 2>{2, 0});
  file.write_text("/VTKHDF", "Type", "UnstructuredGrid");
  const auto write_count = [&file](const std::string& name, std::size_t count) {
    const auto number = static_cast<std::int64_t>(count);
    file.write<std::int64_t>(name, {&number, 1}, {1});
  };
  write_count("/VTKHDF/NumberOfPoints", points.size() / 3);
  write_count("/VTKHDF/NumberOfCells", types.size());
  write_count("/VTKHDF/NumberOfConnectivityIds", connectivity.size());
  file.write<double>("/VTKHDF/Points", points, {points.size() / 3, 3});
  file.write<std::uint8_t>("/VTKHDF/Types", types, {types.size()});
  file.write<std::int64_t>("/VTKHDF/Offsets", offsets, {offsets.size()});
  file.write<std::int64_t>("/VTKHDF/Connectivity", connectivity, {connectivity.size()});
}

void write_vtk_steps(File& file, const std::vector<double>& times) {
  const hsize_t frames = times.size();
  const std::vector<std::int64_t> zeros(frames, 0), ones(frames, 1);
  file.create_group("/VTKHDF/Steps");
  file.write_integers("/VTKHDF/Steps", "NSteps",
                      std::array<std::int64_t, 1>{static_cast<std::int64_t>(frames)});
  file.write<double>("/VTKHDF/Steps/Values", times, {frames});
  file.write<std::int64_t>("/VTKHDF/Steps/PartOffsets", zeros, {frames});
  file.write<std::int64_t>("/VTKHDF/Steps/NumberOfParts", ones, {frames});
  file.write<std::int64_t>("/VTKHDF/Steps/PointOffsets", zeros, {frames});
  file.write<std::int64_t>("/VTKHDF/Steps/CellOffsets", zeros, {frames, 1});
  file.write<std::int64_t>("/VTKHDF/Steps/ConnectivityIdOffsets", zeros, {frames, 1});
}

void create_vtk_point_array(File& file, const std::string& name, hsize_t components, hsize_t points,
                            hsize_t frames, bool varies) {
  std::vector<std::int64_t> rows(frames, 0);
  for (hsize_t j = 0; varies && j < frames; ++j) rows[j] = static_cast<std::int64_t>(j * points);
  file.write<std::int64_t>("/VTKHDF/Steps/PointDataOffsets/" + name, rows, {frames});
  constexpr hsize_t chunk_rows = 32768;  // 0.75 MB: one chunk is read to get one node's neighbourhood
  Shape shape = {varies ? frames * points : points};
  if (components > 1) shape.push_back(components);
  file.create_dataset<double>("/VTKHDF/PointData/" + name, shape, std::min(points, chunk_rows));
}

}  // namespace cleft::h5
