// Polygons of a .ply file (Stanford's triangle format: text, or binary of either byte order). Our own reader,
// since VTK's trusts the counts and indices of a file, and crashes where they are wrong.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "base/vec3.h"

namespace cleft {

struct PlyPolygons {
  std::vector<Vec3> points;
  std::vector<std::vector<int>> polygons;  ///< indices into points, each at least 0 and below points.size()
};

/// Reads the elements 'vertex' (x, y, z) and 'face' (a list vertex_indices or vertex_index); all else is
/// skipped. Throws FileError, naming the line of the header or the number of the element, where the file is
/// not whole and consistent.
PlyPolygons read_ply(const std::string& path);

}  // namespace cleft
