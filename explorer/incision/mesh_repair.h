// The quality of a mesh that was read from a file, and repairs that do not move points.
#pragma once

#include "explorer/incision/surface_mesh.h"

namespace cleft {

struct MeshReport {
  int points = 0, triangles = 0;  ///< of the mesh as repaired
  int merged_points = 0;          ///< at the same place as another
  int degenerate_triangles = 0;   ///< without area, left out
  int duplicate_triangles = 0;    ///< with the corners of another, left out
  int turned_triangles = 0;       ///< reversed to agree with most of their component
  int components = 0;             ///< that share no point
  int boundary_edges = 0;         ///< with one triangle
  int non_manifold_edges = 0;     ///< with more than two, or with two that cannot be made to agree
  int non_manifold_vertices = 0;  ///< whose triangles form more than one fan
  int inside_out_components = 0;  ///< closed, with negative volume: cavities, or normals that point in
};

/// Removes duplicate triangles and reverses those that disagree with the majority of their component. Indices
/// must be in range. Cuts stop where the result is not a manifold.
SurfaceMesh repaired(const SurfaceMesh& mesh, MeshReport& report);

}  // namespace cleft
