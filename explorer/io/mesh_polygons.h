// What a mesh file's own reader makes of it. Private to this folder.
#pragma once

#include <string>
#include <vector>

#include "explorer/incision/surface_mesh.h"

namespace cleft {

struct MeshPolygons {
  std::vector<Vec3> points;                ///< in the file's unit
  std::vector<std::vector<int>> polygons;  ///< indices into points, each at least 0 and below points.size()
  std::vector<PointColor> colors = {};     ///< of each point; empty: the file has none
  std::string note = {};                   ///< what is to be said of its textures; empty: it has none
};

}  // namespace cleft
