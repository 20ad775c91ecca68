// A B-spline basis made ready for evaluation: on each span its functions in Bernstein form, which is exact at
// the ends and never cancels, and a table of buckets instead of a search for the span.
#pragma once

#include <cstdint>
#include <vector>

#include "encoder/field/bspline.h"
#include "encoder/field/place.h"

namespace cleft {

/// The cubic pieces of four neighbouring functions between two knots; bases of lower degree are elevated, and
/// functions beyond theirs are 0.
struct alignas(32) BasisSpan {
  double share[4][4];    ///< [m][r]: coefficient of the m-th Bernstein polynomial in function first + r
  double begin, length;  ///< s = (x - begin) / length is exactly 0 and 1 at the ends
  int first;
};

class SpanTable {
 public:
  /// Throws InputError where the degree is above 3.
  explicit SpanTable(const BSplineBasis& basis);

  /// Lets find() answer Side::both at `x`, where the basis breaks, with the mean of the two limits. Does
  /// nothing where the limits share functions.
  void break_at(double x, const BSplineBasis& basis);

  const BasisSpan* spans() const { return spans_.data(); }
  int span_count() const { return static_cast<int>(ends_.size()); }  ///< between knots, in their order
  int size() const { return size_; }  ///< control points, with zeros behind them where a span needs four
  /// Number of the span in which x lies: x at a knot belongs to the span before it from the left, else to the
  /// one behind it. Any x is allowed; those outside belong to the first or the last span.
  int find(double x, Limit limit) const {
    const double bucket = (x - front_) * scale_;
    int span = starts_[bucket > 0 ? static_cast<int>(bucket < last_bucket_ ? bucket : last_bucket_) : 0];
    if (limit == Limit::from_right)
      for (int k = 0; k < ends_a_bucket_; ++k) span += x >= ends_[span];
    else
      for (int k = 0; k < ends_a_bucket_; ++k) span += x > ends_[span];
    return span;
  }
  /// The same for an axis that may break: `side` matters at the break only.
  int find(double x, Side side) const {
    if (x == break_ && side == Side::both) return mean_;
    return find(x, side == Side::left ? Limit::from_left : Limit::from_right);
  }

  /// Values of functions first .. first + 3 at x, clamped; returns first.
  int evaluate(double x, double (&value)[4]) const;

 private:
  double bucket_of(double x) const;

  double front_, back_, scale_, last_bucket_;
  double break_;  // NaN where there is none
  int size_, mean_ = 0, ends_a_bucket_ = 0;
  std::vector<BasisSpan> spans_;
  std::vector<double> ends_;  // of the spans; infinite for the last
  std::vector<std::uint16_t> starts_;
};

}  // namespace cleft
