// Sums of outer products of vectors over the unknowns of a wedge, of which tangents are made.
#pragma once

#include <Eigen/Core>

#include "base/error.h"

namespace cleft {

class OuterProducts {
 public:
  using Vector = Eigen::Matrix<double, 18, 1>;
  using Matrix = Eigen::Matrix<double, 18, 18>;

  static constexpr int most = 12;

  /// Adds left right^T; at most `most` of them.
  void add(const Vector& left, const Vector& right) {
    CLEFT_CHECK(count_, <, most);
    Vector::Map(left_[count_]) = left;
    left_[count_][18] = left_[count_][19] = 0;
    Vector::Map(right_[count_]) = right;
    ++count_;
  }

  Matrix sum() const;

 private:
  static constexpr int padded = 20;  // numbers of `left`: whole vectors of four
  int count_ = 0;
  alignas(32) double left_[most][padded];
  double right_[most][18];
};

}  // namespace cleft
