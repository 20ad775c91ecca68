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

Covariance::Jets Covariance::along_rows(const Eigen::MatrixXd& x, const Eigen::MatrixXd& dx,
                                        const Eigen::VectorXd& y, const Eigen::VectorXd& dy) const {
  const Eigen::ArrayXd s = 1 + (x * y).array(), by_x = (dx * y).array(), by_y = (x * dy).array();
  const Eigen::ArrayXd first = trend * degree * s.pow(degree - 1);
  Jets jets{trend * s.pow(degree), first * by_x, first * by_y, first * (dx * dy).array()};
  if (degree > 1) jets.by_both += trend * degree * (degree - 1) * s.pow(degree - 2) * by_x * by_y;
  if (correlation == Correlation::none) return jets;
  // Of z = (x - y) / lengths, u = dx / lengths and v = dy / lengths.
  Eigen::ArrayXd squared = Eigen::ArrayXd::Zero(x.rows()), zu = squared, zv = squared, uv = squared;
  for (Eigen::Index k = 0; k < x.cols(); ++k) {
    const Eigen::ArrayXd z = (x.col(k).array() - y[k]) / lengths[k], u = dx.col(k).array() / lengths[k];
    squared += z.square(), zu += z * u, zv += z * (dy[k] / lengths[k]), uv += u * (dy[k] / lengths[k]);
  }
  if (correlation == Correlation::gaussian) {
    const Eigen::ArrayXd e = (-0.5 * squared).exp();
    jets.value += e, jets.by_x -= e * zu, jets.by_y += e * zv, jets.by_both += e * (uv - zu * zv);
    return jets;
  }
  const Eigen::ArrayXd r = (5 * squared).sqrt(), e = (-r).exp(), slope = 5. / 3 * (1 + r) * e;
  jets.value += (1 + r + r.square() / 3) * e, jets.by_x -= slope * zu, jets.by_y += slope * zv;
  jets.by_both += slope * uv - 25. / 3 * e * zu * zv;
  return jets;
}

}  // namespace cleft
