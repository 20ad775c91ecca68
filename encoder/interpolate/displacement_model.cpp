#include "encoder/interpolate/displacement_model.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "encoder/interpolate/convex_hull.h"
#include "encoder/interpolate/field_samples.h"

namespace cleft {

namespace {

// Of the ratios of residual and deviation, cases left out: most in between then lie below the estimate.
constexpr double share_below_estimate = 0.95;
constexpr Eigen::Index few_points = 2000;

double quantile(std::vector<double> values, double share) {
  const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1) + 0.5);
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[static_cast<std::size_t>(at)];
}

/// Exponents of the power law in the features that fits the columns' norms best.
Eigen::VectorXd exponents_of(const Eigen::MatrixXd& places, const Eigen::VectorXd& norms) {
  const Eigen::Index n = places.rows(), d = places.cols();
  if (n < d + 1 || norms.minCoeff() <= 0) return Eigen::VectorXd::Zero(d);
  Eigen::MatrixXd design(n, d + 1);
  design << Eigen::VectorXd::Ones(n), places;
  return design.completeOrthogonalDecomposition().solve(norms.array().log().matrix().eval()).tail(d);
}

Eigen::MatrixXd few_of(const Eigen::MatrixXd& samples) {
  const Eigen::Index points = samples.rows() / 3, stride = std::max<Eigen::Index>(1, points / few_points) | 1;
  std::vector<Eigen::Index> rows;
  for (Eigen::Index point = 0; point < points; point += stride)
    for (Eigen::Index c = 0; c < 3; ++c) rows.push_back(3 * point + c);
  return samples(rows, Eigen::all);
}

}  // namespace

DisplacementModel::DisplacementModel(const std::vector<CaseParameters>& cases, const Eigen::MatrixXd& samples,
                                     Loading loading)
    : features_(cases, loading) {
  const auto n = static_cast<Eigen::Index>(cases.size());
  places_.resize(n, features_.size()), loads_.resize(n, features_.load(cases[0]).size()), scales_.resize(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const CaseParameters& one = cases[static_cast<std::size_t>(i)];
    places_.row(i) = features_.at(one).transpose(), loads_.row(i) = features_.load(one).transpose();
    const double scale = features_.scale(one);
    scales_[i] = scale > 0 ? scale : 1;
  }
  if (!sees_curvature()) {
    const Eigen::MatrixXd normal = samples * scales_.cwiseInverse().asDiagonal();
    const Covariance straight{"", 1,    Covariance::Correlation::none,
                              1,  1e-9, Eigen::VectorXd::Ones(features_.size())};
    plain_.emplace(
        Plain{scales_, {{places_, loads_, normal.transpose() * normal}, straight}, few_of(samples)});
  }
  exponents_ = exponents_of(places_, samples.colwise().norm().transpose().cwiseQuotient(scales_));
  scales_.array() *= (places_ * exponents_).array().exp();
  const Eigen::MatrixXd normal = samples * scales_.cwiseInverse().asDiagonal();
  choose({places_, loads_, normal.transpose() * normal}, normal);
}

void DisplacementModel::choose(const TrainingCases& training, const Eigen::MatrixXd& normal) {
  const Eigen::Index n = normal.cols();
  for (KernelRegression& regression : all_methods(training)) {
    const Eigen::MatrixXd residuals = normal * regression.left_out();
    Eigen::VectorXd errors(n);
    std::vector<double> ratios;
    for (Eigen::Index i = 0; i < n; ++i) {
      const double residual = largest_point(residuals.col(i));
      errors[i] = residual / std::max(largest_point(normal.col(i)), 1e-300);
      ratios.push_back(residual / regression.left_out_deviation()[i]);
    }
    const double error = std::sqrt(errors.squaredNorm() / static_cast<double>(n));
    if (regression_ && error >= left_out_error_) continue;
    regression_.emplace(std::move(regression));
    errors_ = errors, left_out_error_ = error;
    error_of_deviation_ = quantile(ratios, share_below_estimate);
  }
}

/// Two values of a feature tell nothing of what is between them, nor do cases left out.
bool DisplacementModel::sees_curvature() const {
  for (Eigen::Index f = 0; f < places_.cols(); ++f) {
    std::vector<double> values(places_.col(f).begin(), places_.col(f).end());
    std::sort(values.begin(), values.end());
    const auto same = [](double a, double b) { return b - a < 1e-6; };
    if (std::unique(values.begin(), values.end(), same) - values.begin() < 3) return false;
  }
  return true;
}

DisplacementModel::Prediction DisplacementModel::at(const CaseParameters& parameters) const {
  const Eigen::VectorXd place = features_.at(parameters), load = features_.load(parameters);
  const double scale = features_.scale(parameters) * std::exp(exponents_.dot(place));
  Prediction prediction{scale * regression_->weights(place, load).cwiseQuotient(scales_),
                        scale * error_of_deviation_ * regression_->deviation(place, load)};
  if (plain_) {  // then how far two models are apart says more
    const Eigen::VectorXd other =
        features_.scale(parameters) * plain_->regression.weights(place, load).cwiseQuotient(plain_->scales);
    prediction.error =
        std::hypot(prediction.error, largest_point(plain_->samples * (prediction.weights - other)));
  }
  return prediction;
}

double DisplacementModel::outside(const CaseParameters& parameters) const {
  const Eigen::VectorXd load = features_.load(parameters);
  const Eigen::MatrixXd loads = loads_.transpose();
  const double unknown = (loads * loads.completeOrthogonalDecomposition().solve(load) - load).norm();
  const double distance =
      0.5 * std::hypot(distance_to_hull(places_, features_.at(parameters)), features_.off(parameters));
  return std::hypot(distance, unknown > 1e-6 ? unknown : 0);
}

}  // namespace cleft
