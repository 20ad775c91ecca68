// Where the path's vertices are put: which vertex, edge or face takes a place of the path so that the
// triangles around it keep their shape. Nothing is changed here. Inside explorer/incision only.
#pragma once

#include <optional>

#include "explorer/incision/incision_state.h"

namespace cleft {

/// A place in a triangle: at one of its vertices, on one of its edges, or inside it.
PathStep placed(const IncisionState& cut, int triangle, const Vec3& place, double s);

/// At a vertex of the edge that is crossed, if the path passes the vertex closely enough; no later than at
/// `to`, unless the vertex is near.
std::optional<PathStep> snapped(const IncisionState& cut, const PathStep& crossing, double to);

}  // namespace cleft
