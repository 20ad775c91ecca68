#include "encoder/field/history.h"

#include <algorithm>

namespace cleft {

Vec3 evaluate(const History& history, double t) {
  const auto& breaks = history.breaks;
  const auto next = std::upper_bound(breaks.begin() + 1, breaks.end() - 1, t);
  const auto i = next - breaks.begin() - 1;
  const double s = std::clamp((t - breaks[i]) / (breaks[i + 1] - breaks[i]), 0., 1.), r = 1 - s;
  const auto& c = history.controls[i];
  return r * r * r * c[0] + 3 * r * r * s * c[1] + 3 * r * s * s * c[2] + s * s * s * c[3];
}

}  // namespace cleft
