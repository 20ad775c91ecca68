// Refinement near the path before it is cut: a smooth wound needs triangles smaller than the wound.
#pragma once

#include <vector>

#include "explorer/incision/cut_mesh.h"
#include "explorer/incision/scalpel_path.h"

namespace cleft {

/// What is asked of the triangles near the path. Lengths in the mesh's units.
struct Refinement {
  double height;     ///< of the skin over the path
  double max_edge;   ///< of triangles within `band` of the path
  double band;       ///< half width of the strip about the path
  bool may_coarsen;  ///< where slivers would take too many triangles: else an InputError
};

/// Splits edges at their middles by longest-edge bisection (Rivara 1984: angles stay above half the smallest
/// of the input, and the mesh conforming) until triangles within the band have edges up to max_edge. Beyond
/// the band the limit grows with the distance. Where that takes more triangles than a strip of good ones
/// would by far, because the mesh has slivers, the limit holds within the band alone, and then grows if it
/// may. The shape of the surface does not change. Throws InputError, naming the edge's length or the vertex,
/// before the work where the strip would take too many triangles, or a triangle's coordinates are rounded too
/// coarsely to be split so finely; and where slivers take too many and max_edge is to be kept. The mesh is
/// then as it was.
void refine_along(CutMesh& mesh, const ScalpelPath& path, const Refinement& how);
/// The same along the path from one place to another, for the part of the skin connected to `seeds` there:
/// the work does not depend on the size of the mesh.
void refine_along(CutMesh& mesh, const ScalpelPath& path, double from, double to,
                  const std::vector<int>& seeds, const Refinement& how);

/// Bisects triangle t, after those across ever longer edges that must be bisected first. False if one of
/// these edges is not manifold, or too short to have a middle.
bool bisect(CutMesh& mesh, int t);

/// The length of the longest edge.
double longest_edge_length(const CutMesh& mesh, int t);

}  // namespace cleft
