#include "encoder/import/decoded_vtkhdf.h"

#include "base/h5/vtkhdf.h"

namespace cleft {

DecodedVtkHdf::DecodedVtkHdf(const std::string& path, const SourceMesh& mesh,
                             const std::vector<double>& times)
    : file_(h5::File::create(path)), nodes_(mesh.points.size()), frames_(times.size()) {
  h5::write_vtk_mesh(file_, {&mesh.points.data()->x, 3 * nodes_}, mesh.cell_types, mesh.cell_offsets,
                     mesh.connectivity);
  h5::write_vtk_steps(file_, times);
}

void DecodedVtkHdf::write(std::size_t frame, const std::string& name, int components,
                          std::span<const double> numbers, const std::string& unit) {
  const std::string array = "/VTKHDF/PointData/" + name;
  if (frame == 0) {
    h5::create_vtk_point_array(file_, name, static_cast<hsize_t>(components), nodes_, frames_, true);
    if (!unit.empty()) file_.write_text(array, "UNITS_LABEL", unit);
  }
  file_.write_rows<double>(array, frame * nodes_, nodes_, numbers);
}

}  // namespace cleft
