// Conversion between VTK's polygons and a SurfaceMesh. Private to this folder.
#pragma once

#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <string>
#include <vector>

#include "explorer/io/mesh_file.h"

namespace cleft {

/// The triangles of `data`, repaired; `report` is added to. Throws FileError naming `path`.
SurfaceMesh mesh_of_polygons(vtkPolyData* data, const std::string& path, MeshReport* report);

void add_arrays(const std::vector<PointArray>& arrays, vtkPointData* to, std::size_t points);

}  // namespace cleft
