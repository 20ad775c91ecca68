#include "encoder/import/decoded_vtkhdf.h"

#include <algorithm>
#include <array>

namespace cleft {

DecodedVtkHdf::DecodedVtkHdf(const std::string& path, const SourceMesh& mesh,
                             const std::vector<double>& times)
    : file_(h5::File::create(path)), nodes_(mesh.points.size()), frames_(times.size()) {
  file_.create_group("/VTKHDF");
  file_.write_integers("/VTKHDF", "Version", std::array<std::int64_t, 2>{2, 0});
  file_.write_text("/VTKHDF", "Type", "UnstructuredGrid");
  const auto write_count = [this](const std::string& name, std::size_t count) {
    const auto number = static_cast<std::int64_t>(count);
    file_.write<std::int64_t>(name, {&number, 1}, {1});
  };
  write_count("/VTKHDF/NumberOfPoints", nodes_);
  write_count("/VTKHDF/NumberOfCells", mesh.cell_types.size());
  write_count("/VTKHDF/NumberOfConnectivityIds", mesh.connectivity.size());
  file_.write<double>("/VTKHDF/Points", {&mesh.points.data()->x, 3 * nodes_}, {nodes_, 3});
  file_.write<std::uint8_t>("/VTKHDF/Types", mesh.cell_types, {mesh.cell_types.size()});
  file_.write<std::int64_t>("/VTKHDF/Offsets", mesh.cell_offsets, {mesh.cell_offsets.size()});
  file_.write<std::int64_t>("/VTKHDF/Connectivity", mesh.connectivity, {mesh.connectivity.size()});
  const std::vector<std::int64_t> zeros(frames_, 0), ones(frames_, 1);
  file_.create_group("/VTKHDF/Steps");
  file_.write_integers("/VTKHDF/Steps", "NSteps",
                       std::array<std::int64_t, 1>{static_cast<std::int64_t>(frames_)});
  file_.write<double>("/VTKHDF/Steps/Values", times, {frames_});
  file_.write<std::int64_t>("/VTKHDF/Steps/PartOffsets", zeros, {frames_});
  file_.write<std::int64_t>("/VTKHDF/Steps/NumberOfParts", ones, {frames_});
  file_.write<std::int64_t>("/VTKHDF/Steps/PointOffsets", zeros, {frames_});
  file_.write<std::int64_t>("/VTKHDF/Steps/CellOffsets", zeros, {frames_, 1});
  file_.write<std::int64_t>("/VTKHDF/Steps/ConnectivityIdOffsets", zeros, {frames_, 1});
}

void DecodedVtkHdf::write(std::size_t frame, const std::string& name, int components,
                          std::span<const double> numbers) {
  const std::string dataset = "/VTKHDF/PointData/" + name;
  if (frame == 0) {
    std::vector<std::int64_t> rows(frames_);
    for (std::size_t j = 0; j < frames_; ++j) rows[j] = static_cast<std::int64_t>(j * nodes_);
    file_.write<std::int64_t>("/VTKHDF/Steps/PointDataOffsets/" + name, rows, {frames_});
    h5::Shape shape = {frames_ * nodes_};
    if (components > 1) shape.push_back(static_cast<hsize_t>(components));
    constexpr hsize_t chunk_rows = 32768;
    file_.create_dataset<double>(dataset, shape, std::min<hsize_t>(nodes_, chunk_rows));
  }
  file_.write_rows<double>(dataset, frame * nodes_, nodes_, numbers);
}

}  // namespace cleft
