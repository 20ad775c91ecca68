// Where places are relative to a path.
#include <algorithm>
#include <cmath>
#include <limits>

#include "explorer/incision/incision_tolerances.h"
#include "explorer/incision/scalpel_path.h"

namespace cleft {

using Limits = IncisionTolerances;

PathCoordinates ScalpelPath::coordinates(const Vec3& x) const { return coordinates(x, 0, length()); }

PathCoordinates ScalpelPath::coordinates(const Vec3& x, double from, double to) const {
  // The nearest sample in the window, then the zero of g(s) = (x - C(s)) . along(s) beside it.
  const std::size_t first = interval(std::max(from, 0.0)), last = interval(std::min(to, length())) + 1;
  std::size_t nearest = first;
  double least = squared_norm(x - samples_[first].position);
  for (std::size_t i = first + 1; i <= last; ++i) {
    const double distance = squared_norm(x - samples_[i].position);
    if (distance < least) least = distance, nearest = i;
  }
  const auto ahead = [&](double s) {
    const PathFrame f = at(s);
    return dot(x - f.position, f.along);
  };
  double lo = samples_[nearest].s, hi = lo, g_lo = ahead(lo), g_hi = g_lo;
  std::size_t i = nearest;
  while (g_hi > 0 && i + 1 < samples_.size() && i < last)
    lo = hi, g_lo = g_hi, g_hi = ahead(hi = samples_[++i].s);
  while (g_lo < 0 && i > 0 && i > first) hi = lo, g_hi = g_lo, g_lo = ahead(lo = samples_[--i].s);
  double s = lo;
  if (g_lo < 0)
    s = lo + g_lo;  // before the start: the frame is constant there (or the window's end)
  else if (g_hi > 0)
    s = hi + g_hi;
  else if (g_lo > 0 && g_hi < 0) {
    double g = g_lo;
    for (int k = 0; k < Limits::nearest_steps; ++k) {  // secant, kept inside by the bracket (Illinois)
      s = lo + (hi - lo) * g_lo / (g_lo - g_hi);
      const double before = g;
      g = ahead(s);
      if (std::abs(g) <= Limits::nearest_place * length()) break;
      if (g > 0) {
        lo = s, g_lo = g;
        if (before > 0) g_hi /= 2;
      } else {
        hi = s, g_hi = g;
        if (before < 0) g_lo /= 2;
      }
      if (hi - lo <= Limits::nearest_place * length()) break;
    }
  } else {
    s = g_lo == 0 ? lo : hi;
  }
  const PathFrame f = at(s);
  return {s, dot(x - f.position, f.across), dot(x - f.position, f.outward)};
}

double ScalpelPath::steady_place(const Vec3& x, const PathCoordinates& at) const {
  const double distance = std::abs(at.v);
  if (distance <= Limits::in_the_way * length()) return at.s;
  const Vec3 up = this->at(at.s).outward;
  double sum = 0, weights = 0;
  for (int k = 1 - Limits::steady_points; k < Limits::steady_points; k += 2) {
    const double part = static_cast<double>(k) / Limits::steady_points;
    const double s = at.s + Limits::steady_window * part * distance;
    const PathFrame frame = this->at(s);
    Vec3 away = x - frame.position;
    away -= dot(away, up) * up;
    const double nearness = distance * distance / std::max(squared_norm(away), distance * distance),
                 inside = 1 - part * part,
                 weight = nearness * nearness * nearness * nearness * inside * inside;
    sum += weight * (s - at.s + dot(away, frame.along)), weights += weight;
  }
  const double aside = sum / weights;
  return std::abs(aside) > Limits::steady_rounding * (length() + distance) ? at.s + aside : at.s;
}

double ScalpelPath::room(double s, bool right) const {
  // The smallest circle that touches the path at C(s) and meets it again. Very near to s that would be the
  // curvature of a hand's tremor.
  const PathFrame frame = at(s);
  const Vec3 aside = right ? frame.across : -frame.across;
  double room = std::numeric_limits<double>::infinity();
  for (const Sample& sample : samples_) {
    const Vec3 away = sample.position - frame.position;
    const double beside = dot(away, aside);
    if (std::abs(sample.s - s) > Limits::tremor * length() && beside > Limits::straight * length())
      room = std::min(room, squared_norm(away) / (2 * beside));
  }
  return room;
}

}  // namespace cleft
