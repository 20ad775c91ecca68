// Surface meshes from and to files, in the formats of explorer/io/formats/mesh_formats.h. VTK's own types
// stay out of here.
#pragma once

#include <string>
#include <vector>

#include "explorer/incision/mesh_repair.h"

namespace cleft {

/// Reads a surface of any format of the table: polygons become triangles, points at the same place one point,
/// and triangles without area, duplicate triangles or points without triangles are dropped, and triangles
/// that disagree with most of their component are reversed; `report` counts these changes, if given. Throws
/// InputError for another ending and FileError for a file that is missing, damaged or has no triangles.
SurfaceMesh read_mesh(const std::string& path, MeshReport* report = nullptr);

/// An array of the points of a mesh.
struct PointArray {
  std::string name;
  int components = 1;          ///< 1 or 3
  std::vector<double> values;  ///< components for each point
};

/// Writes the format of the ending of `path`, completely or not at all; the table states which of them keep
/// the arrays. Throws InputError for an ending that Cleft does not write: call surface_format() before long
/// work.
void write_mesh(const std::string& path, const SurfaceMesh& mesh, const std::vector<PointArray>& arrays = {});

}  // namespace cleft
