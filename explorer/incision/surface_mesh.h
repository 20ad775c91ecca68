// A triangle mesh as read from a file, for cuts and pictures.
#pragma once

#include <array>
#include <vector>

#include "base/vec3.h"

namespace cleft {

/// Triangles are counter-clockwise seen from outside. Units are the mesh's own.
struct SurfaceMesh {
  std::vector<Vec3> points;
  std::vector<std::array<int, 3>> triangles;
};

}  // namespace cleft
