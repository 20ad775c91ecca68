#include "encoder/interpolate/kernel_regression.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace cleft {

namespace {

Eigen::MatrixXd matrix_of(const TrainingCases& cases, const Covariance& covariance) {
  const Eigen::Index n = cases.features.rows();
  Eigen::MatrixXd K(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j <= i; ++j)
      K(i, j) = K(j, i) = cases.loads.row(i).dot(cases.loads.row(j)) *
                          covariance(cases.features.row(i).transpose(), cases.features.row(j).transpose());
  return K;
}

/// Coordinate descent on logarithms: the error is smooth in them, and seldom has more than one minimum.
Covariance tuned(const TrainingCases& cases, Covariance covariance, bool one_length, bool with_nugget) {
  const Eigen::Index d = cases.features.cols();
  double best = KernelRegression(cases, covariance).left_out_error();
  const auto attempt = [&](Covariance changed) {
    if (changed.lengths.minCoeff() < 0.05 || changed.lengths.maxCoeff() > 200 || changed.nugget < 1e-9 ||
        changed.nugget > 0.1)
      return false;
    const double error = KernelRegression(cases, changed).left_out_error();
    if (!(error < best * (1 - 1e-6))) return false;
    best = error, covariance = std::move(changed);
    return true;
  };
  const Eigen::Index knobs = (one_length ? 1 : d) + (with_nugget ? 1 : 0);
  for (double step = 4; step > 1.15; step = std::sqrt(step)) {
    bool moved = true;
    for (int round = 0; moved && round < 8; ++round) {
      moved = false;
      for (Eigen::Index knob = 0; knob < knobs; ++knob)
        for (const double factor : {step, 1 / step}) {
          Covariance changed = covariance;
          if (with_nugget && knob == knobs - 1)
            changed.nugget *= factor * factor;
          else if (one_length)
            changed.lengths *= factor;
          else
            changed.lengths[knob] *= factor;
          if (attempt(std::move(changed))) moved = true;
        }
    }
  }
  return covariance;
}

}  // namespace

double Covariance::operator()(const Eigen::VectorXd& x, const Eigen::VectorXd& y) const {
  double value = trend * std::pow(1 + x.dot(y), degree);
  if (correlation == Correlation::none) return value;
  const double squared = (x - y).cwiseQuotient(lengths).squaredNorm();
  if (correlation == Correlation::gaussian) return value + std::exp(-0.5 * squared);
  const double r = std::sqrt(5 * squared);
  return value + (1 + r + r * r / 3) * std::exp(-r);
}

KernelRegression::KernelRegression(const TrainingCases& cases, Covariance covariance)
    : features_(cases.features),
      loads_(cases.loads),
      matrix_(matrix_of(cases, covariance)),
      covariance_(std::move(covariance)),
      nugget_(covariance_.nugget *
              covariance_(Eigen::VectorXd::Zero(features_.cols()), Eigen::VectorXd::Zero(features_.cols()))) {
  const Eigen::Index n = features_.rows();
  factor_.compute(matrix_ + nugget_ * Eigen::MatrixXd::Identity(n, n));
  left_out_ = factor_.solve(Eigen::MatrixXd::Identity(n, n));
  left_out_deviation_.resize(n);
  double sum = 0;
  for (Eigen::Index i = 0; i < n; ++i) {
    const double diagonal = std::max(left_out_(i, i), 1e-300);
    left_out_.col(i) /= diagonal;
    left_out_deviation_[i] = 1 / std::sqrt(diagonal);
    const double whole = std::max(cases.gram(i, i), 1e-300);
    sum += std::max(0., left_out_.col(i).dot(cases.gram * left_out_.col(i))) / whole;
  }
  left_out_error_ = std::sqrt(sum / static_cast<double>(n));
  if (!std::isfinite(left_out_error_)) left_out_error_ = 1e300;
}

Eigen::VectorXd KernelRegression::against(const Eigen::VectorXd& features,
                                          const Eigen::VectorXd& load) const {
  Eigen::VectorXd k(features_.rows());
  for (Eigen::Index i = 0; i < k.size(); ++i)
    k[i] = loads_.row(i).dot(load) * covariance_(features_.row(i).transpose(), features);
  return k;
}

Eigen::VectorXd KernelRegression::weights(const Eigen::VectorXd& features,
                                          const Eigen::VectorXd& load) const {
  return factor_.solve(against(features, load));
}

double KernelRegression::deviation(const Eigen::VectorXd& features, const Eigen::VectorXd& load) const {
  const Eigen::VectorXd k = against(features, load);
  const Eigen::VectorXd w = factor_.solve(k);
  const double own = load.squaredNorm() * covariance_(features, features);
  // Of the prediction w as it was rounded: own - k . K^-1 k would only add up the errors of w.
  const double variance = own - 2 * k.dot(w) + w.dot(matrix_ * w) + nugget_ * w.squaredNorm();
  return std::sqrt(std::max(variance, 0.) + nugget_);
}

std::vector<KernelRegression> all_methods(const TrainingCases& cases) {
  using enum Covariance::Correlation;
  const Eigen::VectorXd lengths = Eigen::VectorXd::Constant(cases.features.cols(), 2.0);
  std::vector<KernelRegression> methods;
  methods.emplace_back(cases, Covariance{"linear polynomial", 1, none, 1, 1e-9, lengths});
  if (cases.features.cols() == 0) return methods;
  methods.emplace_back(cases, Covariance{"quadratic polynomial", 2, none, 1, 1e-9, lengths});
  methods.emplace_back(cases,
                       tuned(cases, {"radial basis functions", 1, matern, 100, 1e-9, lengths}, true, false));
  std::optional<KernelRegression> process;
  for (const int degree : {1, 2}) {
    KernelRegression one(
        cases, tuned(cases, {"Gaussian process", degree, gaussian, 100, 1e-6, lengths}, false, true));
    if (!process || one.left_out_error() < process->left_out_error()) process.emplace(std::move(one));
  }
  methods.push_back(std::move(*process));
  return methods;
}

}  // namespace cleft
