// Planes in the space of the source.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/vec3.h"

namespace cleft {

/// Points x with normal . x = offset; the normal has length 1.
struct Plane {
  Vec3 normal;
  double offset = 0;
  double distance(const Vec3& x) const { return dot(normal, x) - offset; }
};

/// "nx,ny,nz,offset", of any length. Throws InputError.
Plane parse_plane(const std::string& text);
std::string text_of(const Plane& plane);

/// Axes of the points' spread, the largest first: right-handed, unit vectors. A unit vector within 1e-9 of an
/// axis of the space is replaced by that axis.
struct Spread {
  Vec3 centre;
  Vec3 axis[3];
  double deviation[3];  ///< standard deviation along each
};
Spread spread_of(const std::vector<Vec3>& points);

/// The plane of all points, up to `tolerance`, with a forward normal; none if there is none or more than one
/// (a line). `within`: the normal of a plane mesh, in which a line of points determines the plane.
std::optional<Plane> common_plane(const std::vector<Vec3>& points, double tolerance,
                                  const std::optional<Vec3>& within = {});

/// The axis or its opposite: the one whose largest component is positive.
Vec3 forward(const Vec3& axis);

/// The unit vector, or the axis that it nearly equals.
Vec3 snapped(const Vec3& unit);

}  // namespace cleft
