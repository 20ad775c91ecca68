// Refinement near the path before it is cut: a smooth wound needs triangles smaller than the wound.
#pragma once

#include <vector>

#include "explorer/incision/cut_mesh.h"
#include "explorer/incision/scalpel_path.h"

namespace cleft {

/// Splits edges at their middles by longest-edge bisection (Rivara 1984: angles stay above half the smallest
/// of the input, and the mesh conforming) until triangles within `band` of the path have edges up to
/// `max_edge`. Beyond the band the limit grows with the distance. `height` is that of the skin over the path.
/// The shape of the surface does not change.
void refine_along(CutMesh& mesh, const ScalpelPath& path, double height, double max_edge, double band);
/// The same along the path from one place to another, for the part of the skin connected to `seeds` there:
/// the work does not depend on the size of the mesh.
void refine_along(CutMesh& mesh, const ScalpelPath& path, double from, double to,
                  const std::vector<int>& seeds, double height, double max_edge, double band);

/// Bisects triangle t, after those across ever longer edges that must be bisected first. False if one of
/// these edges is not manifold.
bool bisect(CutMesh& mesh, int t);

/// The length of the longest edge.
double longest_edge_length(const CutMesh& mesh, int t);

}  // namespace cleft
