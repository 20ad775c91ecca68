// The map from a body as it lies to the canonical coordinates of a break that is no plane.
#pragma once

#include <optional>
#include <vector>

#include "base/vec3.h"
#include "encoder/field/parametrization.h"

namespace cleft {

/// A break as a surface v = f(u, w) over its best plane, in mm: f is a spline with uniform knots, cubic along
/// u and along w. Canonical coordinates are (u, v - f(u, w), w - top): on the break v = 0, in the body w <=
/// 0. Those of a break with a round front (a penny crack, an elliptic one at a face) are polar ones instead
/// of u and w.
class BreakMap {
 public:
  /// The basis over an interval, in whole spans; without spans it is constant.
  struct Axis {
    Interval over;
    int spans = 0;

    int size() const { return spans == 0 ? 1 : spans + 3; }
    /// The values of the four functions that do not vanish at x, the first of which has number `first`.
    /// Beyond the interval they go on linearly.
    struct Values {
      int first, count;
      double value[4];
    };
    Values at(double x) const;
  };

  /// Of a round front around a centre: u is the distance from it, with distances along w multiplied by
  /// `stretch`; w is the angle about it, from -w toward u, less `last`, times `radius`. A front all around
  /// has places at both ends of the angle: those within `overlap` of one end have another beyond the other
  /// end.
  struct Round {
    double u = 0, w = 0, stretch = 1, radius = 1, last = 0;
    static constexpr double overlap = 0.35;

    bool whole_circle() const { return last > 3.2; }
  };

  /// coefficients: [i * height.size() + k].
  BreakMap(Axis along, Axis height, std::vector<double> coefficients, double top = 0,
           std::optional<Round> round = {});

  /// The plane v = 0.
  BreakMap() : BreakMap(Axis{}, Axis{}, {0}) {}
  BreakMap with(double top, std::optional<Round> round) const {
    return {along_, height_, coefficients_, top, round};
  }

  double surface(double u, double w) const;
  Vec3 canonical(const Vec3& placed) const;
  /// A second place of the same point, of a front all around.
  std::optional<Vec3> again(const Vec3& canonical) const;
  const std::optional<Round>& round() const { return round_; }

  /// As numbers for files, and back; throws InputError if they are no such map.
  std::vector<double> numbers() const;
  static BreakMap from(const std::vector<double>& numbers);

 private:
  Axis along_, height_;
  std::vector<double> coefficients_;
  double top_;
  std::optional<Round> round_;
};

}  // namespace cleft
