#include "encoder/field/parametrization/tip.h"

#include <limits>

namespace cleft {

namespace {

/// r a / (r + a): r itself near 0, never beyond a.
double bounded(double r, double a) { return r * a / (r + a); }
double bounded_slope(double r, double a) { return a * a / ((r + a) * (r + a)); }

/// A distance r from one end of an interval of length l, of which only this end counts: 0 .. 1.
double from_end(double r, double l, double a) { return r * (l + a) / (l * (r + a)); }

}  // namespace

/// The distance from the start and the tip over which knots keep their density.
double TipParametrization::scale() const {
  const CanonicalCut& cut = geometry().cut;
  return cut.depth > 0 ? 3 * cut.depth : cut.length;
}

/// With the tip at `tip`, at which it moves by `speed` a unit of t.
inline Parametrization::Along TipParametrization::along_at(double u, double tip, double speed) const {
  const auto [front, back] = domain()[0];
  const double start = geometry().cut.start, a = scale();
  if (u <= start) {
    const double l = start - front, r = start - u;
    if (l <= 0) return {1, 0, 0};
    return {1 - from_end(r, l, a), (l + a) / l * a / ((r + a) * (r + a)), 0};
  }
  if (u < tip) {
    // Both ends count: (G(r) - G(l - r) + G(l)) / (2 G(l)), r from the start.
    const double l = tip - start, r = u - start, rest = l - r;
    const double whole = bounded(l, a), part = bounded(r, a) - bounded(rest, a);
    const double by_l =
        -bounded_slope(rest, a) / (2 * whole) - part * bounded_slope(l, a) / (2 * whole * whole);
    return {1.5 + part / (2 * whole), (bounded_slope(r, a) + bounded_slope(rest, a)) / (2 * whole),
            by_l * speed};
  }
  const double l = back - tip, r = u - tip;
  if (l <= 0) return {2, 0, 0};
  const double by_r = (l + a) / l * a / ((r + a) * (r + a)), by_l = -r * a / (l * l * (r + a));
  return {2 + from_end(r, l, a), by_r, -(by_r + by_l) * speed};
}

double TipParametrization::u_at(double along, double t) const {
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

double TipParametrization::v_at(double across) const {
  const auto [front, back] = domain()[1];
  return across * (across < 0 ? -front : back);
}

double TipParametrization::w_at(double height) const {
  const double bottom = domain()[2].front, depth = geometry().cut.depth;
  if (depth >= -bottom) return height * -bottom;
  return height > -1 ? height * depth : -depth + (height + 1) * (-bottom - depth);
}

double TipParametrization::time_at(double parameter) const { return parameter * domain()[3].back; }

}  // namespace cleft
