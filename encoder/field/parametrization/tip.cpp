#include "encoder/field/parametrization/tip.h"

#include <limits>

namespace cleft {

/// With the tip at `tip`, at which it moves by `speed` a unit of t.
inline Parametrization::Along TipParametrization::along_at(double u, double tip, double speed) const {
  const auto [front, back] = domain()[0];
  const double start = geometry().cut.start;
  if (u <= start) {
    const double length = start - front;
    return length > 0 ? Along{(u - front) / length, 1 / length, 0} : Along{1, 0, 0};
  }
  if (u < tip) {
    const double part = (u - start) / (tip - start);
    return {1 + part, 1 / (tip - start), -part * speed / (tip - start)};
  }
  const double length = back - tip;
  if (length <= 0) return {2, 0, 0};
  const double part = (u - tip) / length;
  return {2 + part, 1 / length, (part - 1) * speed / length};
}

Parametrization::Along TipParametrization::along(double u, double t) const {
  return along_at(u, geometry().tip.at(t), geometry().tip.speed(t));
}

void TipParametrization::map(std::span<const Place> places, BasisPlace* out) const {
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

Parametrization::Single TipParametrization::across(double v) const {
  const auto [front, back] = domain()[1];
  const double width = v < 0 ? -front : back;
  return {v / width, 1 / width};
}

Parametrization::Single TipParametrization::height(double w) const {
  const double bottom = domain()[2].front, depth = geometry().cut.depth;
  if (depth >= -bottom) return {w / -bottom, 1 / -bottom};
  if (depth > 0 && w > -depth) return {w / depth, 1 / depth};
  const double below = -bottom - depth;
  return {-1 + (w + depth) / below, 1 / below};
}

Parametrization::Single TipParametrization::time(double t) const {
  const double duration = domain()[3].back;
  return {t / duration, 1 / duration};
}

double TipParametrization::time_at(double parameter) const { return parameter * domain()[3].back; }

}  // namespace cleft
