// Exact predicates for sides, independent of rounding (CGAL's filtered predicates).
#pragma once

#include "base/vec3.h"

namespace cleft {

/// The side on which the directed edge a -> b passes the line from `foot` to `head`: 1 if the line, seen
/// along head -> foot, is to the left of the edge, as it does for the edges of a counter-clockwise triangle
/// that it pierces; -1 to the right; 0 if line and edge are coplanar. Exact for the numbers given.
int side_of_line(const Vec3& foot, const Vec3& head, const Vec3& a, const Vec3& b);

/// Whether three points are exactly collinear.
bool collinear(const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace cleft
