#include "encoder/field/bspline.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/text.h"

namespace cleft {

namespace {

void append_uniform(std::vector<double>& knots, int spans, double front, double back) {
  for (int i = 1; i < spans; ++i) knots.push_back(front + (back - front) * i / spans);
}

void append_repeated(std::vector<double>& knots, int times, double value) {
  knots.insert(knots.end(), times, value);
}

}  // namespace

BSplineBasis::BSplineBasis(int degree, std::vector<double> knots)
    : degree_(degree), knots_(std::move(knots)) {
  if (degree < 1 || degree > max_degree)
    throw InputError("degree " + std::to_string(degree) + " of a B-spline: must be 1 to 5");
  const std::size_t order = degree + 1;
  const auto finite = [](double knot) { return std::isfinite(knot); };
  const bool valid = knots_.size() >= 2 * order && std::all_of(knots_.begin(), knots_.end(), finite) &&
                     std::is_sorted(knots_.begin(), knots_.end()) && knots_[order - 1] == knots_.front() &&
                     knots_[knots_.size() - order] == knots_.back() && knots_.front() < knots_[order] &&
                     knots_[knots_.size() - order - 1] < knots_.back();
  if (!valid)
    throw InputError("a knot vector of degree " + std::to_string(degree) +
                     " must be sorted, finite and open at both ends");
}

BSplineBasis BSplineBasis::uniform(int degree, int count, double front, double back) {
  if (count <= degree)
    throw InputError(std::to_string(count) + " control points on an axis: degree " + std::to_string(degree) +
                     " needs at least " + std::to_string(degree + 1));
  std::vector<double> knots;
  append_repeated(knots, degree + 1, front);
  append_uniform(knots, count - degree, front, back);
  append_repeated(knots, degree + 1, back);
  return {degree, std::move(knots)};
}

BSplineBasis BSplineBasis::broken(int degree, int count, double front, double at, double back) {
  if (count < 2 * (degree + 1))
    throw InputError(std::to_string(count) + " control points across the cut: degree " +
                     std::to_string(degree) + " needs at least " + std::to_string(2 * (degree + 1)));
  if (!(front < at && at < back))
    throw InputError("the cut plane at " + shortest(at) + " lies outside (" + shortest(front) + ", " +
                     shortest(back) + ")");
  std::vector<double> knots;
  append_repeated(knots, degree + 1, front);
  append_uniform(knots, count / 2 - degree, front, at);
  append_repeated(knots, degree + 1, at);
  append_uniform(knots, count - count / 2 - degree, at, back);
  append_repeated(knots, degree + 1, back);
  return {degree, std::move(knots)};
}

int BSplineBasis::span(double x, Limit limit) const {
  // Largest i with knots[i] <= x < knots[i+1]; from the left, knots[i] < x <= knots[i+1].
  const auto inside_begin = knots_.begin() + degree_ + 1, inside_end = knots_.end() - degree_ - 1;
  const auto next = limit == Limit::from_right ? std::upper_bound(inside_begin, inside_end, x)
                                               : std::lower_bound(inside_begin, inside_end, x);
  return static_cast<int>(next - knots_.begin()) - 1;
}

BSplineBasis::Values BSplineBasis::evaluate(double x, Limit limit) const {
  x = std::clamp(x, front(), back());
  const int i = span(x, limit);
  Values result{i - degree_, {}};
  auto& n = result.value;
  std::array<double, max_degree + 1> left, right;
  n[0] = 1;
  for (int j = 1; j <= degree_; ++j) {  // Cox - de Boor; Piegl and Tiller, The NURBS Book, A2.2
    left[j] = x - knots_[i + 1 - j];
    right[j] = knots_[i + j] - x;
    double saved = 0;
    for (int r = 0; r < j; ++r) {
      const auto R = r, J = j;
      const double term = n[R] / (right[R + 1] + left[J - R]);
      n[R] = saved + right[R + 1] * term;
      saved = left[J - R] * term;
    }
    n[j] = saved;
  }
  return result;
}

}  // namespace cleft
