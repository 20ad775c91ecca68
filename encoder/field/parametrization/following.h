// The parametrisations that follow the tip of the cut. All parameters are normalised:
//   along   0 patch's edge, 1 start of the cut, 2 tip at time t, 3 far edge; between them monotone and
//   smooth, such
//           that knots lie at nearly the same distances from start and tip while the cut grows
//   across  -1 .. 0 left of the cut, 0 .. 1 right of it
//   height  0 skin, -1 bottom of the cut, -2 bottom of the patch (-1 where the cut goes through)
//   time    0 .. 1
// They differ in how a distance from the start or the tip is measured (tip.h, front.h).
#pragma once

#include <cmath>
#include <limits>

#include "encoder/field/parametrization.h"

namespace cleft {

/// A distance from the start or the tip as it is measured, and its derivative.
struct Measured {
  double value, slope;
};

/// `Measure` has a name `id`, resolves_front, and functions of a distance r, mm, where a is the distance over
/// which knots keep their density, all 0 at 0 and increasing: Measured measured(r, a) along the cut, bounded;
/// beside(r, a) away from its plane; and from_beside(part, l, a), the r at which beside() is a part of what
/// it is at l.
template <class Measure>
class FollowingParametrization final : public Parametrization {
 public:
  using Parametrization::Parametrization;
  static constexpr const char* id = Measure::id;
  std::string name() const override { return id; }

  Along along(double u, double t) const override {
    return along_at(u, geometry().tip.at(t), geometry().tip.speed(t));
  }

  Single across(double v) const override {
    const auto [front, back] = domain()[1];
    const double width = v < 0 ? -front : back;
    const Measured part = Measure::beside(std::abs(v), scale()), whole = Measure::beside(width, scale());
    return {std::copysign(part.value / whole.value, v), part.slope / whole.value};
  }

  Single height(double w) const override {
    const double bottom = domain()[2].front, depth = geometry().cut.depth;
    if (depth >= -bottom) return {w / -bottom, 1 / -bottom};
    if (depth > 0 && w > -depth) return {w / depth, 1 / depth};
    const double below = -bottom - depth;
    return {-1 + (w + depth) / below, 1 / below};
  }

  Single time(double t) const override {
    const double duration = domain()[3].back;
    return {t / duration, 1 / duration};
  }

  double u_at(double along, double t) const override {
    const auto [front, back] = domain()[0];
    const double start = geometry().cut.start, tip = geometry().tip.at(t);
    double low = along <= 1   ? front
                 : along <= 2 ? start
                              : tip,
           high = along <= 1   ? start
                  : along <= 2 ? tip
                               : back;
    for (int i = 0; i < 60; ++i) {  // increasing between them
      const double middle = 0.5 * (low + high);
      (this->along(middle, t).value < along ? low : high) = middle;
    }
    return 0.5 * (low + high);
  }

  double v_at(double across) const override {
    const auto [front, back] = domain()[1];
    const double width = across < 0 ? -front : back;
    return std::copysign(Measure::from_beside(std::abs(across), width, scale()), across);
  }

  double w_at(double height) const override {
    const double bottom = domain()[2].front, depth = geometry().cut.depth;
    if (depth >= -bottom) return height * -bottom;
    return height > -1 ? height * depth : -depth + (height + 1) * (-bottom - depth);
  }

  double time_at(double parameter) const override { return parameter * domain()[3].back; }

  bool moves() const override { return true; }
  bool resolves_front() const override { return Measure::resolves_front; }
  bool moves_at(double u) const override { return u > geometry().cut.start && u < domain()[0].back; }

  Moving moving(double u, double t) const override {
    return {along_at(u, geometry().tip.at(t), 0).value, FollowingParametrization::time(t).value};
  }

  void map(std::span<const Place> places, BasisPlace* out) const override {
    // Neighbours in a list are mostly of one time: the tip is looked up where t changes.
    double t = std::numeric_limits<double>::quiet_NaN(), tip = t;
    for (const Place& place : places) {
      if (const double now = inside(place.t, 3); now != t) t = now, tip = geometry().tip.at(t);
      const double v = inside(place.uvw.y, 1);
      *out++ = {{along_at(inside(place.uvw.x, 0), tip, 0).value, across(v).value,
                 height(inside(place.uvw.z, 2)).value, time(t).value},
                v == 0 ? place.side : side_of(v)};
    }
  }

 private:
  /// The distance from the start and the tip over which knots keep their density.
  double scale() const {
    const CanonicalCut& cut = geometry().cut;
    return cut.depth > 0 ? 3 * cut.depth : cut.length;
  }

  /// With the tip at `tip`, at which it moves by `speed` a unit of t. With M(r) as r is measured: 1 - M(r) /
  /// M(l) before the start, 1.5 + (M(r) - M(l - r)) / (2 M(l)) along the cut, where both ends count, and
  /// 2 + M(r) / M(l) ahead of the tip; l is the length of the interval.
  Along along_at(double u, double tip, double speed) const {
    const auto [front, back] = domain()[0];
    const double start = geometry().cut.start, a = scale();
    const auto measured = [a](double r) { return Measure::measured(r, a); };
    if (u <= start) {
      const double l = start - front;
      if (l <= 0) return {1, 0, 0};
      const Measured part = Measure::ahead(start - u, a), whole = Measure::ahead(l, a);
      return {1 - part.value / whole.value, part.slope / whole.value, 0};
    }
    if (u < tip) {
      const Measured whole = measured(tip - start), from_start = measured(u - start),
                     from_tip = measured(tip - u);
      const double part = from_start.value - from_tip.value;
      const double by_l = -(from_tip.slope + part * whole.slope / whole.value) / (2 * whole.value);
      return {1.5 + part / (2 * whole.value), (from_start.slope + from_tip.slope) / (2 * whole.value),
              by_l * speed};
    }
    const double l = back - tip;
    if (l <= 0) return {2, 0, 0};
    const Measured part = Measure::ahead(u - tip, a), whole = Measure::ahead(l, a);
    const double by_r = part.slope / whole.value,
                 by_l = -part.value * whole.slope / (whole.value * whole.value);
    return {2 + part.value / whole.value, by_r, -(by_r + by_l) * speed};
  }
};

}  // namespace cleft
