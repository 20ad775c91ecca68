#include "encoder/ladder.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace cleft {

namespace {

constexpr int degree = 3;

/// The first spans - 1 of 1/2, 1/4, 3/4, 1/8, 3/8, ..., sorted: a longer list contains the shorter ones.
std::vector<double> nested(int spans) {
  std::vector<double> places;
  for (int denominator = 2; static_cast<int>(places.size()) < spans - 1; denominator *= 2)
    for (int i = 1; i < denominator && static_cast<int>(places.size()) < spans - 1; i += 2)
      places.push_back(static_cast<double>(i) / denominator);
  std::sort(places.begin(), places.end());
  return places;
}

double crowded(double s) { return s * s; }  // toward 0
double crowded_at_both(double s) { return s < 0.5 ? 2 * s * s : 1 - 2 * (1 - s) * (1 - s); }

struct Knots {
  std::vector<double> list;
  void repeat(double knot, int times) { list.insert(list.end(), times, knot); }
  BSplineBasis basis(int p = degree) { return {p, std::move(list)}; }
};

}  // namespace

std::array<BSplineBasis, 4> bases_of(const Rung& rung, const FieldGeometry& geometry, int frames) {
  const auto [front, back] = geometry.domain[0];
  Knots along;
  const bool from_edge = geometry.cut.start <= front, to_edge = geometry.tip.positions.front() >= back;
  if (!from_edge) {
    along.repeat(0, degree + 1);
    const std::vector<double> s = nested(rung.before);
    for (auto i = s.rbegin(); i != s.rend(); ++i) along.list.push_back(1 - crowded(*i));
  }
  along.repeat(1, from_edge ? degree + 1 : degree);
  for (const double s : nested(rung.along)) along.list.push_back(1 + crowded_at_both(s));
  along.repeat(2, to_edge ? degree + 1 : degree);
  if (!to_edge) {
    for (const double s : nested(rung.after)) along.list.push_back(2 + crowded(s));
    along.repeat(3, degree + 1);
  }

  Knots across;
  const std::vector<double> beside = nested(rung.across);
  across.repeat(-1, degree + 1);
  for (auto i = beside.rbegin(); i != beside.rend(); ++i) across.list.push_back(-crowded(*i));
  across.repeat(0, degree + 1);
  for (const double s : beside) across.list.push_back(crowded(s));
  across.repeat(1, degree + 1);

  Knots height;
  const bool through = geometry.cut.depth >= -geometry.domain[2].front;
  if (!through) {
    height.repeat(-2, degree + 1);
    const std::vector<double> s = nested(rung.below);
    for (auto i = s.rbegin(); i != s.rend(); ++i) height.list.push_back(-1 - crowded(*i));
  }
  height.repeat(-1, through ? degree + 1 : degree);
  for (const double s : nested(rung.above)) height.list.push_back(-1 + crowded(s));
  height.repeat(0, degree + 1);

  Knots time;
  const int p = std::min(degree, frames - 1);
  time.repeat(0, p + 1);
  for (const double s : nested(std::clamp(rung.time, 1, frames - p))) time.list.push_back(s);
  time.repeat(1, p + 1);
  return {along.basis(), across.basis(), height.basis(), time.basis(p)};
}

}  // namespace cleft
