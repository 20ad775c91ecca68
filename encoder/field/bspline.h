// A univariate B-spline basis of any degree up to 5 over an open knot vector.
#pragma once

#include <array>
#include <vector>

namespace cleft {

/// From which side a basis is evaluated at a knot where it is discontinuous.
enum class Limit { from_left, from_right };

class BSplineBasis {
 public:
  static constexpr int max_degree = 5;

  /// `knots` must be non-decreasing with degree + 1 equal knots at both ends; throws InputError if not.
  BSplineBasis(int degree, std::vector<double> knots);

  /// `count` control points on uniform knots over [front, back]. Needs count > degree.
  static BSplineBasis uniform(int degree, int count, double front, double back);

  /// Uniform knots on each side of `at`, and a knot of full multiplicity there: discontinuous at `at`. The
  /// `count` control points are divided into halves; needs count >= 2 (degree + 1).
  static BSplineBasis broken(int degree, int count, double front, double at, double back);

  int degree() const { return degree_; }
  int size() const { return static_cast<int>(knots_.size()) - degree_ - 1; }  ///< number of control points
  const std::vector<double>& knots() const { return knots_; }
  bool operator==(const BSplineBasis& other) const = default;
  double front() const { return knots_.front(); }
  double back() const { return knots_.back(); }

  /// The degree + 1 functions that do not vanish at x (clamped to the domain), beginning with number `first`.
  struct Values {
    int first;
    std::array<double, max_degree + 1> value;
  };
  Values evaluate(double x, Limit limit = Limit::from_right) const;

 private:
  int span(double x, Limit limit) const;

  int degree_;
  std::vector<double> knots_;
};

}  // namespace cleft
