#include "encoder/import/break_surface.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace cleft {

namespace {

double length(const Interval& i) { return i.back - i.front; }

int spans_over(const Interval& domain, double spacing, int most) {
  return std::clamp(static_cast<int>(std::ceil(length(domain) / spacing)), 4, most);
}

/// Least squares on all places, with next to no weight of second differences of the coefficients.
BreakMap fitted(const std::vector<Vec3>& places, const BreakMap::Axis& along, const BreakMap::Axis& height) {
  constexpr double roughness = 1e-8;
  const int U = along.size(), W = height.size(), size = U * W;
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd right = Eigen::VectorXd::Zero(size);
  using Row = std::vector<std::pair<int, double>>;
  const auto add = [&](const Row& row, double weight) {
    for (const auto& [i, a] : row)
      for (const auto& [k, b] : row) entries.emplace_back(i, k, weight * a * b);
  };
  for (const Vec3& place : places) {
    const auto a = along.at(place.x), h = height.at(place.z);
    Row row;
    for (int i = 0; i < a.count; ++i)
      for (int k = 0; k < h.count; ++k)
        row.emplace_back((a.first + i) * W + h.first + k, a.value[i] * h.value[k]);
    add(row, 1);
    for (const auto& [i, value] : row) right(i) += value * place.y;
  }
  for (int i = 0; i < U; ++i)
    for (int k = 0; k < W; ++k) {
      const auto at = [&](int di, int dk) { return (i + di) * W + k + dk; };
      if (i + 2 < U) add({{at(0, 0), 1}, {at(1, 0), -2}, {at(2, 0), 1}}, roughness);
      if (k + 2 < W) add({{at(0, 0), 1}, {at(0, 1), -2}, {at(0, 2), 1}}, roughness);
      if (i + 1 < U && k + 1 < W)
        add({{at(0, 0), 1}, {at(1, 0), -1}, {at(0, 1), -1}, {at(1, 1), 1}}, roughness);
    }
  for (int i = 0; i < size; ++i) entries.emplace_back(i, i, 1e-6 * roughness);
  Eigen::SparseMatrix<double> matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Eigen::VectorXd x = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(matrix).solve(right);
  return {along, height, {x.data(), x.data() + size}};
}

double farthest_from(const BreakMap& map, const std::vector<Vec3>& places) {
  double farthest = 0;
  for (const Vec3& p : places) farthest = std::max(farthest, std::abs(p.y - map.surface(p.x, p.z)));
  return farthest;
}

}  // namespace

Interval range_of(const std::vector<Vec3>& places, int axis) {
  const auto [low, high] = std::minmax_element(
      places.begin(), places.end(), [=](const Vec3& a, const Vec3& b) { return a[axis] < b[axis]; });
  return {(*low)[axis], (*high)[axis]};
}

BreakMap surface_through(const BreakPlaces& places, double& farthest) {
  constexpr int most_along = 256, most_high = 48;
  std::vector<Vec3> all = places.pairs;
  for (const auto* more : {&places.front, &places.beyond}) all.insert(all.end(), more->begin(), more->end());
  const Interval u = range_of(all, 0), w = range_of(all, 2);
  const double count = static_cast<double>(all.size());
  // Knots at half the spacing of places.
  std::vector<double> columns;
  columns.reserve(all.size());
  for (const Vec3& p : all) columns.push_back(p.x);
  std::sort(columns.begin(), columns.end());
  const auto last = std::unique(columns.begin(), columns.end(),
                                [&](double a, double b) { return b - a <= places.rounding; });
  const double spacing = length(u) / std::max(1., static_cast<double>(last - columns.begin()) - 1);
  BreakMap extruded = fitted(all, {places.u, spans_over(places.u, spacing / 2, most_along)}, {});
  farthest = farthest_from(extruded, all);
  if (farthest <= places.rounding || length(w) <= places.rounding) return extruded;
  const double apart = std::sqrt(length(u) * length(w) / count) / 2;
  BreakMap general = fitted(all, {places.u, spans_over(places.u, apart, most_along)},
                            {places.w, spans_over(places.w, apart, most_high)});
  farthest = farthest_from(general, all);
  return general;
}

std::optional<BreakMap::Round> round_front(const BreakPlaces& places) {
  if (places.front.size() < 8) return {};
  const Interval u = range_of(places.front, 0), w = range_of(places.front, 2),
                 of_pairs = range_of(places.pairs, 2);
  if (!(length(u) > 0 && length(w) > 0)) return {};
  const Interval pairs_u = range_of(places.pairs, 0);
  const bool closed_first =
      u.front<pairs_u.front - places.rounding, closed_last = u.back> pairs_u.back + places.rounding,
             closed_below = w.front<of_pairs.front - places.rounding, closed_above = w.back> of_pairs.back +
                            places.rounding;
  const bool in_corner = closed_first != closed_last;  // of two faces, one above and one beside
  if (!closed_below || !(closed_first || closed_last) || (in_corner && closed_above)) return {};
  constexpr double pi = std::numbers::pi;
  BreakMap::Round round;
  round.u = !in_corner ? (u.front + u.back) / 2 : closed_last ? pairs_u.front : pairs_u.back;
  round.w = closed_above ? (w.front + w.back) / 2 : of_pairs.back;
  // An arm of breaks that cross begins at the others, far from the body's faces.
  const double to_face = closed_last ? round.u - places.u.front : places.u.back - round.u;
  constexpr double near_face = 0.1;  // of the length of the front
  if (in_corner && to_face > near_face * length(u)) return {};
  const double wide = std::max(closed_first ? round.u - u.front : 0, closed_last ? u.back - round.u : 0),
               high = round.w - w.front;
  std::size_t within = 0;
  for (const Vec3& p : places.front) {
    const double to_u = wide - std::abs(p.x - round.u),
                 to_w = high - (closed_above ? std::abs(p.z - round.w) : round.w - p.z);
    within += std::min(to_u / wide / (in_corner ? 1 : 2), to_w / high / (closed_above ? 2 : 1)) > 0.05;
  }
  if (3 * within < places.front.size()) return {};
  round.stretch = wide / high;
  round.last = closed_above ? pi + BreakMap::Round::overlap : in_corner && closed_first ? 0 : pi / 2;
  // Parameters over which knots lie as densely as over a cut three times as long as deep.
  round.radius = wide / 3 / (in_corner ? pi / 2 : 2 * round.last);
  return round;
}

}  // namespace cleft
