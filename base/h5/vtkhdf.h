// What every temporal VTKHDF 2.0 UnstructuredGrid with one mesh has.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/h5/h5.h"

namespace cleft::h5 {

/// /VTKHDF with the mesh: `points` are x, y, z of one after another; types are VTK's, offsets one more than
/// the cells.
void write_vtk_mesh(File& file, std::span<const double> points, const std::vector<std::uint8_t>& types,
                    const std::vector<std::int64_t>& offsets, const std::vector<std::int64_t>& connectivity);
/// /VTKHDF/Steps: that mesh at all times.
void write_vtk_steps(File& file, const std::vector<double>& times);
/// /VTKHDF/PointData/<name>, to be filled with write_rows: one for all frames, or frame after frame.
void create_vtk_point_array(File& file, const std::string& name, hsize_t components, hsize_t points,
                            hsize_t frames, bool varies);

}  // namespace cleft::h5
