// Follows the front of the cut, with distances from it measured as displacements grow there: with the square
// root. A cubic of the parameter then holds the powers 1/2, 1 and 3/2 of the distance, so that the opening is
// right between the nodes next to the front too, where the lips close as an ellipse does (Westergaard 1939).
#pragma once

#include <cmath>

#include "encoder/field/parametrization/tip.h"

namespace cleft {

struct FrontMeasure {
  static constexpr const char* id = "front";
  static constexpr bool resolves_front = true;
  /// Over a, from where the square root goes over into the distance itself; and from where it begins, so that
  /// no slope is infinite at the front.
  static constexpr double rooted = 0.3, blunt = 0.02;
  static constexpr double wide = 3;

  /// x a / (x + a) of x = sqrt((r + e) (r + e + b)) - sqrt(e (e + b)), b = rooted a, e = blunt a.
  static Measured measured(double r, double a) {
    const double b = rooted * a, from = blunt * a, s = r + from;
    const double root = std::sqrt(s * (s + b)), x = root - std::sqrt(from * (from + b));
    const double part = a / (x + a);
    return {x * part, part * part * (s + 0.5 * b) / root};
  }

  /// Where nothing opens: evenly, as in tip.h.
  static Measured ahead(double r, double a) { return EvenMeasure::measured(r, a); }

  /// r c / (r + c), c = 3 a: knots keep their distances from the plane of the cut however wide the patch is.
  static Measured beside(double r, double a) {
    const double c = wide * a, part = c / (r + c);
    return {r * part, part * part};
  }
  static double from_beside(double part, double l, double a) {
    const double c = wide * a, value = part * l * c / (l + c);
    return value * c / (c - value);
  }
};

using FrontParametrization = FollowingParametrization<FrontMeasure>;

}  // namespace cleft
