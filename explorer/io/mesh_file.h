// Surface meshes from and to files, through VTK. Its own types stay out of here.
#pragma once

#include <string>
#include <vector>

#include "explorer/incision/mesh_repair.h"

namespace cleft {

/// Reads .stl, .obj, .ply or .vtp: polygons become triangles, points at the same place one point, and
/// triangles without area, duplicate triangles or points without triangles are dropped, and triangles that
/// disagree with most of their component are turned over; `report` tells, where given. Throws InputError for
/// another ending and FileError for a file that is missing, damaged or has no triangles.
SurfaceMesh read_mesh(const std::string& path, MeshReport* report = nullptr);

/// Numbers that belong to the points of a mesh.
struct PointArray {
  std::string name;
  int components = 1;          ///< 1 or 3
  std::vector<double> values;  ///< components for each point
};

/// Throws InputError where write_mesh knows no format for the ending: to be asked before long work.
void check_mesh_ending(const std::string& path);

/// Writes .vtp, .obj or .stl by the ending of `path`, whole or not at all. Only .vtp keeps the arrays.
void write_mesh(const std::string& path, const SurfaceMesh& mesh, const std::vector<PointArray>& arrays = {});

}  // namespace cleft
