// Marching tetrahedra: a closed, consistently oriented first mesh of an implicit surface.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "examples/head/head_shape.h"

namespace cleft::head {

/// Triangles are counter-clockwise seen from outside; lengths in mm.
struct TriangleMesh {
  std::vector<Vec3> points;
  std::vector<std::array<int, 3>> triangles;
};

/// The surface distance = 0 inside the box, as triangles. Every cube of the
/// grid is split into six tetrahedra, so that there are no ambiguous cases and no cracks.
TriangleMesh march(const std::function<double(const Vec3&)>& distance, const Box& box, double spacing);

}  // namespace cleft::head
