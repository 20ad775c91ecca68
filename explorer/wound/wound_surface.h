// The surface of a mesh with its cuts, as scenes draw it, without fields and VTK.
#pragma once

#include <array>
#include <vector>

#include "base/vec3.h"
#include "explorer/incision/cut_mesh.h"

namespace cleft {

/// A surface with an incision, fully cut; at t = 0 its lips coincide. Lengths in mm.
struct WoundSurface {
  std::vector<Vec3> points;                       ///< at rest
  std::vector<std::array<int, 3>> triangles;      ///< counter-clockwise seen from outside
  std::vector<Region> regions;                    ///< one for each triangle
  std::vector<double> depth_fraction;             ///< one for each point: 0 at the skin, 1 at the bottom
  std::vector<PointColor> colors;                 ///< the mesh's own, one for each point; empty: none
  int original_points = 0;                        ///< the points from this number on were added by the cut
  Vec3 middle, outward{0, 0, 1}, along{1, 0, 0};  ///< of the cut, for the camera
};

/// The mesh with its cuts, at rest; the camera's `middle`, `outward` and `along` keep their defaults.
/// `colors`: of each vertex, or empty.
WoundSurface wound_surface_of(const CutMesh& mesh, int original_points, std::vector<PointColor> colors = {});

}  // namespace cleft
