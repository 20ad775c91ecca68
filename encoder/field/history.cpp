#include "encoder/field/history.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace cleft {

std::array<Vec3, 4> part_of_piece(const std::array<Vec3, 4>& piece, double s0, double s1) {
  if (s0 == 0 && s1 == 1) return piece;
  const auto blossom = [&piece](double a, double b, double c) {
    std::array<Vec3, 4> p = piece;
    for (int level = 3; level > 0; --level) {
      const double s = level == 3 ? a : level == 2 ? b : c;
      for (int i = 0; i < level; ++i) p[i] = lerp(p[i], p[i + 1], s);
    }
    return p[0];
  };
  return {blossom(s0, s0, s0), blossom(s0, s0, s1), blossom(s0, s1, s1), blossom(s1, s1, s1)};
}

void combine(std::span<const History> histories, std::span<const double> factors, History& out) {
  CLEFT_CHECK(histories.size(), ==, factors.size());
  out.breaks.clear(), out.controls.clear(), out.error = 0;
  for (std::size_t k = 0; k < histories.size(); ++k) {
    CLEFT_CHECK(histories[k].breaks.front(), ==, histories[0].breaks.front());
    CLEFT_CHECK(histories[k].breaks.back(), ==, histories[0].breaks.back());
    out.breaks.insert(out.breaks.end(), histories[k].breaks.begin(), histories[k].breaks.end());
    out.error += std::abs(factors[k]) * histories[k].error;
  }
  std::sort(out.breaks.begin(), out.breaks.end());
  out.breaks.erase(std::unique(out.breaks.begin(), out.breaks.end()), out.breaks.end());
  for (std::size_t i = 0; i + 1 < out.breaks.size(); ++i) {
    const double from = out.breaks[i], to = out.breaks[i + 1], middle = from + (to - from) / 2;
    std::array<Vec3, 4> sum{};
    for (std::size_t k = 0; k < histories.size(); ++k) {
      const auto& breaks = histories[k].breaks;
      const auto j = static_cast<std::size_t>(std::upper_bound(breaks.begin() + 1, breaks.end() - 1, middle) -
                                              breaks.begin()) -
                     1;
      const double length = breaks[j + 1] - breaks[j];
      const double s0 = std::clamp((from - breaks[j]) / length, 0., 1.),
                   s1 = to >= breaks[j + 1] ? 1 : std::clamp((to - breaks[j]) / length, 0., 1.);
      const std::array<Vec3, 4> piece = part_of_piece(histories[k].controls[j], s0, s1);
      for (int m = 0; m < 4; ++m) sum[m] += factors[k] * piece[m];
    }
    out.controls.push_back(sum);
  }
}

Vec3 evaluate(const History& history, double t) {
  const auto& breaks = history.breaks;
  const auto next = std::upper_bound(breaks.begin() + 1, breaks.end() - 1, t);
  const auto i = next - breaks.begin() - 1;
  const double s = std::clamp((t - breaks[i]) / (breaks[i + 1] - breaks[i]), 0., 1.), r = 1 - s;
  const auto& c = history.controls[i];
  return r * r * r * c[0] + 3 * r * r * s * c[1] + 3 * r * s * s * c[2] + s * s * s * c[3];
}

}  // namespace cleft
