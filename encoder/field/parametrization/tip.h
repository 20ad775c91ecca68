// Follows the tip, with knots that are evenly distributed near it and near the start of the cut.
#pragma once

#include "encoder/field/parametrization/following.h"

namespace cleft {

struct EvenMeasure {
  static constexpr const char* id = "tip";
  static constexpr bool resolves_front = false;
  /// r a / (r + a): r itself near 0, never beyond a.
  static Measured measured(double r, double a) { return {r * a / (r + a), a * a / ((r + a) * (r + a))}; }
  static Measured ahead(double r, double a) { return measured(r, a); }
  static Measured beside(double r, double) { return {r, 1}; }
  static double from_beside(double part, double l, double) { return part * l; }
};

using TipParametrization = FollowingParametrization<EvenMeasure>;

}  // namespace cleft
