// A closed triangle mesh of an implicit surface, with well-shaped triangles of graded size.
#pragma once

#include <functional>

#include "examples/head/head_shape.h"
#include "examples/head/marching.h"

namespace cleft::head {

struct MeshingTask {
  std::function<double(const Vec3&)> distance;     ///< negative inside
  std::function<Vec3(const Vec3&)> project;        ///< the nearby point of the surface
  std::function<double(const Vec3&)> edge_length;  ///< wanted edge length, up to a common factor
  Box box;                                         ///< holds the whole surface
  double spacing;                                  ///< of the first grid, mm: below the smallest edge wanted
  int triangles;                                   ///< the number in the end; even
};

/// Marching tetrahedra on a grid (always closed and consistently oriented, outwards), then edge collapses
/// down to the number wanted, shortest against the wanted length first, with edge flips and smoothing along
/// the surface.
TriangleMesh mesh_surface(const MeshingTask& task);

/// The head of head_shape.h with `triangles` triangles (even, 4,000 to 20,000), in about a second.
TriangleMesh mesh_head(int triangles);

}  // namespace cleft::head
