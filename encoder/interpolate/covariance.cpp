#include <cmath>

#include "encoder/interpolate/kernel_regression.h"

namespace cleft {

namespace {

/// Of squared distances: numbers, or arrays of them.
template <class Values>
Values correlated(Covariance::Correlation correlation, const Values& squared) {
  using std::exp, std::sqrt;
  if (correlation == Covariance::Correlation::gaussian) return exp(-0.5 * squared);
  const Values r = sqrt(5 * squared);
  return (1 + r + r * r / 3) * exp(-r);
}

}  // namespace

double Covariance::operator()(const Eigen::VectorXd& x, const Eigen::VectorXd& y) const {
  double value = trend * std::pow(1 + x.dot(y), degree);
  if (correlation == Correlation::none) return value;
  return value + correlated(correlation, (x - y).cwiseQuotient(lengths).squaredNorm());
}

Eigen::ArrayXd Covariance::of_rows(const Eigen::MatrixXd& x, const Eigen::RowVectorXd& y) const {
  const Eigen::ArrayXd linear = 1 + (x * y.transpose()).array();
  Eigen::ArrayXd values = trend * (degree == 1 ? linear : linear.pow(degree));
  if (correlation == Correlation::none) return values;
  Eigen::ArrayXd squared = Eigen::ArrayXd::Zero(x.rows());
  for (Eigen::Index k = 0; k < x.cols(); ++k) squared += ((x.col(k).array() - y[k]) / lengths[k]).square();
  return values + correlated(correlation, squared);
}

Covariance::Jet Covariance::along(const Eigen::VectorXd& x, const Eigen::VectorXd& dx,
                                  const Eigen::VectorXd& y, const Eigen::VectorXd& dy) const {
  const double s = 1 + x.dot(y), first = trend * degree * std::pow(s, degree - 1),
               second = degree > 1 ? trend * degree * (degree - 1) * std::pow(s, degree - 2) : 0;
  const double by_x = y.dot(dx), by_y = x.dot(dy);
  Jet jet{trend * std::pow(s, degree), first * by_x, first * by_y, second * by_x * by_y + first * dx.dot(dy)};
  if (correlation == Correlation::none) return jet;
  const Eigen::VectorXd z = (x - y).cwiseQuotient(lengths), u = dx.cwiseQuotient(lengths),
                        v = dy.cwiseQuotient(lengths);
  const double zu = z.dot(u), zv = z.dot(v), uv = u.dot(v), squared = z.squaredNorm();
  if (correlation == Correlation::gaussian) {
    const double e = std::exp(-0.5 * squared);
    return {jet.value + e, jet.by_x - e * zu, jet.by_y + e * zv, jet.by_both + e * (uv - zu * zv)};
  }
  const double r = std::sqrt(5 * squared), e = std::exp(-r), slope = 5. / 3 * (1 + r) * e;
  return {jet.value + (1 + r + r * r / 3) * e, jet.by_x - slope * zu, jet.by_y + slope * zv,
          jet.by_both + slope * uv - 25. / 3 * e * zu * zv};
}

}  // namespace cleft
