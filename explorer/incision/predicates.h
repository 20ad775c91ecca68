// Exact answers to questions about sides, whatever the rounding (CGAL's filtered predicates).
#pragma once

#include "base/vec3.h"

namespace cleft {

/// On which side of the line from `foot` to `head` the directed edge a -> b passes: 1 where the line, seen
/// along head -> foot, lies to the left of the edge, as it does for the edges of a counter-clockwise triangle
/// that it pierces; -1 to the right; 0 where line and edge are coplanar. Exact for the numbers given.
int line_beside_edge(const Vec3& foot, const Vec3& head, const Vec3& a, const Vec3& b);

/// Whether three points lie on one line, exactly.
bool collinear(const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace cleft
