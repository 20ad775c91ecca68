#include "encoder/field/knot_insertion.h"

#include <algorithm>

#include "base/error.h"
#include "base/text.h"

namespace cleft {

namespace {

std::ptrdiff_t multiplicity(const std::vector<double>& knots, double knot) {
  const auto [first, last] = std::equal_range(knots.begin(), knots.end(), knot);
  return last - first;
}

/// Interior knots of full multiplicity: where a spline may jump.
std::vector<double> breaks_of(const BSplineBasis& basis) {
  std::vector<double> breaks;
  for (const double knot : basis.knots())
    if (knot > basis.front() && knot < basis.back() && multiplicity(basis.knots(), knot) > basis.degree() &&
        (breaks.empty() || breaks.back() != knot))
      breaks.push_back(knot);
  return breaks;
}

using Rows = std::vector<std::vector<double>>;

/// Inserts a knot whose multiplicity is `knots` below the degree.
void insert(std::vector<double>& knots, Rows& points, int degree, double x) {
  const auto k = std::upper_bound(knots.begin(), knots.end(), x) - knots.begin() - 1;
  const auto least = k - degree + 1, last = k - multiplicity(knots, x);
  Rows finer(points.begin(), points.begin() + least);
  for (auto i = least; i <= last; ++i) {
    const double share = (x - knots[i]) / (knots[i + degree] - knots[i]);
    std::vector<double> point(points[i].size());
    for (std::size_t n = 0; n < point.size(); ++n)
      point[n] = share * points[i][n] + (1 - share) * points[i - 1][n];
    finer.push_back(std::move(point));
  }
  finer.insert(finer.end(), points.begin() + last, points.end());
  points = std::move(finer);
  knots.insert(knots.begin() + k + 1, x);
}

BandRow without_zeros(const std::vector<double>& weights) {
  const auto some = [](double w) { return w != 0; };
  const auto first = std::find_if(weights.begin(), weights.end(), some);
  const auto last = std::find_if(weights.rbegin(), weights.rend(), some).base();
  return {static_cast<int>(first - weights.begin()), {first, last}};
}

/// One axis of a tensor seen as [before][axis][after].
std::vector<Vec3> along_axis(const std::vector<Vec3>& tensor, const std::vector<BandRow>& rows,
                             std::size_t before, std::size_t size, std::size_t after) {
  std::vector<Vec3> result(before * rows.size() * after);
  for (std::size_t b = 0; b < before; ++b)
    for (std::size_t r = 0; r < rows.size(); ++r)
      for (std::size_t n = 0; n < rows[r].weight.size(); ++n) {
        const double weight = rows[r].weight[n];
        const Vec3* from = &tensor[(b * size + static_cast<std::size_t>(rows[r].first) + n) * after];
        Vec3* to = &result[(b * rows.size() + r) * after];
        for (std::size_t a = 0; a < after; ++a) to[a] += weight * from[a];
      }
  return result;
}

}  // namespace

BSplineBasis common_basis(const BSplineBasis& a, const BSplineBasis& b) {
  if (a.degree() != b.degree())
    throw InputError("one basis is of degree " + std::to_string(a.degree()) + ", another of degree " +
                     std::to_string(b.degree()));
  if (a.front() != b.front() || a.back() != b.back())
    throw InputError("one basis reaches from " + shortest(a.front()) + " to " + shortest(a.back()) +
                     ", another from " + shortest(b.front()) + " to " + shortest(b.back()));
  if (breaks_of(a) != breaks_of(b)) throw InputError("one basis has a break where another has none");
  std::vector<double> knots;
  std::set_union(a.knots().begin(), a.knots().end(), b.knots().begin(), b.knots().end(),
                 std::back_inserter(knots));
  return {a.degree(), std::move(knots)};
}

std::vector<BandRow> knot_insertion(const BSplineBasis& from, const BSplineBasis& to) {
  if (common_basis(from, to).knots() != to.knots())
    throw InputError("a basis cannot be raised to one that lacks some of its knots");
  std::vector<double> knots = from.knots(), missing;
  std::set_difference(to.knots().begin(), to.knots().end(), knots.begin(), knots.end(),
                      std::back_inserter(missing));
  Rows points(static_cast<std::size_t>(from.size()),
              std::vector<double>(static_cast<std::size_t>(from.size())));
  for (std::size_t i = 0; i < points.size(); ++i) points[i][i] = 1;
  for (const double knot : missing) insert(knots, points, from.degree(), knot);
  std::vector<BandRow> rows;
  for (const auto& point : points) rows.push_back(without_zeros(point));
  return rows;
}

std::vector<Vec3> along_axes(const std::vector<Vec3>& tensor, std::array<std::size_t, 4> size,
                             const std::array<std::vector<BandRow>, 4>& rows) {
  CLEFT_CHECK(tensor.size(), ==, size[0] * size[1] * size[2] * size[3]);
  std::vector<Vec3> result = tensor;
  for (std::size_t axis = 0; axis < 4; ++axis) {
    if (rows[axis].empty()) continue;
    std::size_t before = 1, after = 1;
    for (std::size_t other = 0; other < 4; ++other)
      if (other != axis) (other < axis ? before : after) *= size[other];
    result = along_axis(result, rows[axis], before, size[axis], after);
    size[axis] = rows[axis].size();
  }
  return result;
}

std::vector<Vec3> insert_knots(const std::vector<Vec3>& coefficients, const std::array<BSplineBasis, 4>& from,
                               const std::array<BSplineBasis, 4>& to) {
  std::array<std::size_t, 4> size;
  std::array<std::vector<BandRow>, 4> rows;
  for (std::size_t axis = 0; axis < 4; ++axis) {
    size[axis] = static_cast<std::size_t>(from[axis].size());
    if (from[axis].knots() != to[axis].knots()) rows[axis] = knot_insertion(from[axis], to[axis]);
  }
  return along_axes(coefficients, size, rows);
}

}  // namespace cleft
