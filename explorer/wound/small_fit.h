// Weighted least squares for a few unknowns, by the normal equations. Inside explorer/wound only.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace cleft {

/// Columns should be of one size: an unknown whose column is the others' but for 1e-10 of it is none.
template <int n>
class SmallFit {
 public:
  using Row = std::array<double, n>;

  void add(const Row& row, double value, double weight) {
    squares_ += weight * value * value;
    for (int i = 0; i < n; ++i) {
      right_[i] += weight * row[i] * value;
      for (int j = 0; j <= i; ++j) matrix_[i][j] += weight * row[i] * row[j];
    }
    weight_ += weight;
  }

  /// `ridge`: of each unknown, times the sum of the weights; it draws the unknown towards 0. None where the
  /// rows do not determine the unknowns.
  std::optional<Row> solve(const Row& ridge = {}) const {
    constexpr double dependent = 1e-10;
    std::array<Row, n> l{};
    Row x = right_;
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j <= i; ++j) {
        double sum = matrix_[i][j] + (i == j ? weight_ * ridge[i] : 0);
        const double whole = sum;
        for (int k = 0; k < j; ++k) sum -= l[i][k] * l[j][k];
        if (i > j)
          l[i][j] = sum / l[j][j];
        else if (sum > dependent * whole)
          l[i][i] = std::sqrt(sum);
        else
          return std::nullopt;
      }
      for (int k = 0; k < i; ++k) x[i] -= l[i][k] * x[k];
      x[i] /= l[i][i];
    }
    for (int i = n; i-- > 0;) {
      for (int k = i + 1; k < n; ++k) x[i] -= l[k][i] * x[k];
      x[i] /= l[i][i];
    }
    return x;
  }

  /// The root of the mean square of what a solution without a ridge leaves of the values.
  double residual(const Row& solution) const {
    double squares = squares_;
    for (int i = 0; i < n; ++i) squares -= solution[i] * right_[i];
    return weight_ > 0 ? std::sqrt(std::max(0., squares / weight_)) : 0;
  }

 private:
  std::array<Row, n> matrix_{};
  Row right_{};
  double weight_ = 0, squares_ = 0;
};

}  // namespace cleft
