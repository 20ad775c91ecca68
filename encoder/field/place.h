// Places in the tissue, and their parameters in a field's four bases.
#pragma once

#include "base/vec3.h"

namespace cleft {

/// The side of the cut plane v = 0 of a point. It is needed only for points on the plane. `both` is uncut
/// tissue on the plane: the mean of the two sides.
enum class Side : int { left = -1, both = 0, right = 1 };

/// The side by the sign of v; `both` on the plane.
inline Side side_of(double v) { return v < 0 ? Side::left : v > 0 ? Side::right : Side::both; }

/// A point and a time at which a field is evaluated.
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
