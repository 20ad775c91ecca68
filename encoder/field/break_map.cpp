#include "encoder/field/break_map.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"

namespace cleft {

BreakMap::Axis::Values BreakMap::Axis::at(double x) const {
  if (spans == 0) return {0, 1, {1, 0, 0, 0}};
  const double width = (over.back - over.front) / spans, inside = std::clamp(x, over.front, over.back);
  const double place = (inside - over.front) / width;
  const int span = std::clamp(static_cast<int>(place), 0, spans - 1);
  const double t = place - span, s = 1 - t;
  Values values{span,
                4,
                {s * s * s / 6, (3 * t * t * t - 6 * t * t + 4) / 6, (3 * s * s * s - 6 * s * s + 4) / 6,
                 t * t * t / 6}};
  const double beyond = (x - inside) / width;
  const double slope[4] = {-s * s / 2, (3 * t * t - 4 * t) / 2, (-3 * s * s + 4 * s) / 2, t * t / 2};
  for (int i = 0; i < 4; ++i) values.value[i] += beyond * slope[i];
  return values;
}

BreakMap::BreakMap(Axis along, Axis height, std::vector<double> coefficients, double top,
                   std::optional<Round> round)
    : along_(along), height_(height), coefficients_(std::move(coefficients)), top_(top), round_(round) {
  CLEFT_CHECK(coefficients_.size(), ==, static_cast<std::size_t>(along_.size()) * height_.size());
}

double BreakMap::surface(double u, double w) const {
  const Axis::Values a = along_.at(u), h = height_.at(w);
  double sum = 0;
  for (int i = 0; i < a.count; ++i)
    for (int k = 0; k < h.count; ++k)
      sum += a.value[i] * h.value[k] *
             coefficients_[static_cast<std::size_t>(a.first + i) * height_.size() + h.first + k];
  return sum;
}

Vec3 BreakMap::canonical(const Vec3& placed) const {
  const double v = placed.y - surface(placed.x, placed.z);
  if (!round_) return {placed.x, v, placed.z - top_};
  const double x = placed.x - round_->u, z = round_->stretch * (placed.z - round_->w), r = std::hypot(x, z);
  // The angle of a point of the axis is that of its rounding.
  const double angle = r > 1e-6 * round_->radius ? std::atan2(x, -z) : 0;
  return {r, v, (angle - round_->last) * round_->radius};
}

std::optional<Vec3> BreakMap::again(const Vec3& canonical) const {
  if (!round_ || !round_->whole_circle() || canonical.x == 0) return {};
  const double angle = canonical.z / round_->radius + round_->last;
  if (std::abs(angle) < std::numbers::pi - Round::overlap) return {};
  const double turn = std::copysign(2 * std::numbers::pi, angle) * round_->radius;
  return Vec3{canonical.x, canonical.y, canonical.z - turn};
}

std::vector<double> BreakMap::numbers() const {
  const Round round = round_.value_or(Round{});
  std::vector<double> list = {top_,          round_ ? 1. : 0., round.u,   round.w,
                              round.stretch, round.radius,     round.last};
  for (const Axis& axis : {along_, height_})
    list.insert(list.end(), {axis.over.front, axis.over.back, static_cast<double>(axis.spans)});
  list.insert(list.end(), coefficients_.begin(), coefficients_.end());
  return list;
}

BreakMap BreakMap::from(const std::vector<double>& numbers) {
  constexpr std::size_t of_round = 7, header = of_round + 6;
  bool good = numbers.size() > header &&
              std::all_of(numbers.begin(), numbers.end(), [](double x) { return std::isfinite(x); });
  Axis axes[2];
  for (std::size_t i = 0; good && i < 2; ++i) {
    const double *at = &numbers[of_round + 3 * i], spans = at[2];
    good = spans >= 0 && spans <= 1e6 && spans == std::floor(spans) && (spans == 0 || at[0] < at[1]);
    if (good) axes[i] = {{at[0], at[1]}, static_cast<int>(spans)};
  }
  const bool is_round = good && numbers[1] != 0;
  if (!good || (is_round && !(numbers[4] > 0 && numbers[5] > 0)) ||
      static_cast<double>(numbers.size() - header) != static_cast<double>(axes[0].size()) * axes[1].size())
    throw InputError("the numbers of the break's surface are not those of one");
  std::optional<Round> round;
  if (is_round) round = Round{numbers[2], numbers[3], numbers[4], numbers[5], numbers[6]};
  return {axes[0], axes[1], {numbers.begin() + header, numbers.end()}, numbers[0], round};
}

}  // namespace cleft
