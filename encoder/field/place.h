// Places of the tissue, and where they lie in the parameters of a field's four bases.
#pragma once

#include "base/vec3.h"

namespace cleft {

/// On which side of the cut plane v = 0 a point lies. Only points on the plane itself need it told.
/// `both` is uncut tissue on the plane: the mean of the two sides.
enum class Side : int { left = -1, both = 0, right = 1 };

/// The side that the sign of v tells; `both` on the plane itself.
inline Side side_of(double v) { return v < 0 ? Side::left : v > 0 ? Side::right : Side::both; }

/// A point and a time: all that a field is evaluated at.
struct Place {
  Vec3 uvw;  ///< stress-free position, mm
  Side side = Side::both;
  double t = 0;
};

/// A place in the parameters along, across, height and time = 0 .. 3. `side` is `both` only on the plane.
struct alignas(32) BasisPlace {
  double at[4];
  Side side;
};

}  // namespace cleft
