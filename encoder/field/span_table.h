// A B-spline basis prepared for evaluation: on each span its functions in Bernstein form, which is exact at
// the ends and never cancels, and a table of buckets instead of a search for the span.
#pragma once

#include <array>
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
  /// Throws InputError if the degree is above 3.
  explicit SpanTable(const BSplineBasis& basis);

  /// Adds a span at a break x, where the left and right limits share no function: the mean of both limits.
  /// Does nothing if they share one.
  void break_at(double x, const BSplineBasis& basis);

  const BasisSpan* spans() const { return spans_.data(); }
  int span_count() const { return static_cast<int>(ends_.size()); }  ///< between knots, in their order
  int size() const { return size_; }  ///< control points, padded with zeros if a span needs four
  /// Number of the span in which x lies; a knot belongs to the span behind it. Values x outside belong to the
  /// first or the last span.
  int find(double x) const {
    const double bucket = (x - front_) * scale_;
    int span = starts_[bucket > 0 ? static_cast<int>(bucket < last_bucket_ ? bucket : last_bucket_) : 0];
    for (int k = 0; k < ends_a_bucket_; ++k) span += x >= ends_[span];
    return span;
  }

  /// Values of functions first .. first + 3 at x, clamped; returns first.
  int evaluate(double x, double (&value)[4]) const;

 private:
  friend struct Axes;

  double bucket_of(double x) const;

  double front_, back_, scale_, last_bucket_;
  double break_;  // NaN where there is none
  int size_, ends_a_bucket_ = 0;
  std::vector<BasisSpan> spans_;
  std::vector<double> ends_;           // of the spans between knots; infinite for the last
  std::vector<std::uint16_t> starts_;  // first span of each bucket
};

/// The tables of all four axes, and what the kernels read of them side by side.
struct Axes {
  explicit Axes(std::array<SpanTable, 4> of_axes);
  Axes(const Axes&) = delete;
  Axes& operator=(const Axes&) = delete;

  const SpanTable& operator[](int axis) const { return tables[axis]; }

  std::array<SpanTable, 4> tables;
  alignas(32) double front[4], scale[4], last_bucket[4];
  std::array<const BasisSpan*, 4> spans;
  std::array<const double*, 4> ends;
  std::array<const std::uint16_t*, 4> starts;
  int ends_a_bucket = 0;
  double break_at;                             // of axis 1; NaN where there is none
  std::array<const BasisSpan*, 3> at_break{};  // by side, left first
};

}  // namespace cleft
