// A curve through the points of a path, and its length. Inside explorer/incision only.
#pragma once

#include <cmath>
#include <vector>

#include "base/vec3.h"

namespace cleft {

/// Natural cubic spline through values at parameters: C2, and a straight line where the data are one.
class NaturalSpline {
 public:
  NaturalSpline(const std::vector<double>& x, const std::vector<Vec3>& y) : x_(x), y_(y), m_(x.size()) {
    const std::size_t n = x.size();
    std::vector<double> c(n);  // Thomas algorithm for the second derivatives m
    for (std::size_t i = 1; i + 1 < n; ++i) {
      const double h0 = x[i] - x[i - 1], h1 = x[i + 1] - x[i];
      const double pivot = 2 * (h0 + h1) - h0 * c[i - 1];
      c[i] = h1 / pivot;
      m_[i] =
          (1 / pivot) * (6 * ((1 / h1) * (y[i + 1] - y[i]) - (1 / h0) * (y[i] - y[i - 1])) - h0 * m_[i - 1]);
    }
    for (std::size_t i = n - 1; i-- > 1;) m_[i] -= c[i] * m_[i + 1];
  }
  Vec3 value(std::size_t i, double a) const {  // a in [0, 1] over interval i
    const double h = x_[i + 1] - x_[i], b = 1 - a;
    return lerp(y_[i], y_[i + 1], a) + (h * h / 6) * ((b * b * b - b) * m_[i] + (a * a * a - a) * m_[i + 1]);
  }
  Vec3 derivative(std::size_t i, double a) const {
    const double h = x_[i + 1] - x_[i], b = 1 - a;
    return (1 / h) * (y_[i + 1] - y_[i]) + (h / 6) * ((1 - 3 * b * b) * m_[i] + (3 * a * a - 1) * m_[i + 1]);
  }

 private:
  const std::vector<double>& x_;
  const std::vector<Vec3>& y_;
  std::vector<Vec3> m_;
};

/// Arc length over [a0, a1] of interval i, by Gauss's five points.
inline double arc_length(const NaturalSpline& curve, std::size_t i, double step, double a0, double a1) {
  constexpr double node[] = {0, 0.5384693101056831, 0.9061798459386640};
  constexpr double weight[] = {0.5688888888888889, 0.4786286704993665, 0.2369268850561891};
  const double middle = (a0 + a1) / 2, half = (a1 - a0) / 2;
  double sum = 0;
  for (int k = -2; k <= 2; ++k) {
    const int j = std::abs(k);
    sum += weight[j] * norm(curve.derivative(i, middle + (k < 0 ? -half : half) * node[j]));
  }
  return sum * half * step;
}

}  // namespace cleft
