#include "encoder/interpolate/displacement_model.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/error.h"
#include "base/quantiles.h"
#include "encoder/interpolate/convex_hull.h"
#include "encoder/interpolate/field_samples.h"
#include "encoder/interpolate/least_squares.h"
#include "params/consistency.h"

namespace cleft {

namespace {

// Of the ratios of residual and deviation, cases left out: most in between then lie below the estimate.
constexpr double share_below_estimate = 0.95;
constexpr Eigen::Index few_points = 2000;

/// Exponents of the power law in the features that fits the columns' norms best. A load that hardly moves
/// anything has none.
Eigen::VectorXd exponents_of(const Eigen::MatrixXd& places, const Eigen::VectorXd& norms) {
  const Eigen::Index d = places.cols();
  std::vector<Eigen::Index> moved;
  for (Eigen::Index i = 0; i < norms.size(); ++i)
    if (norms[i] > least_size * std::sqrt(norms.squaredNorm() / static_cast<double>(norms.size())))
      moved.push_back(i);
  const auto n = static_cast<Eigen::Index>(moved.size());
  if (n < d + 1) return Eigen::VectorXd::Zero(d);
  Eigen::MatrixXd design(n, d + 1);
  design << Eigen::VectorXd::Ones(n), places(moved, Eigen::all);
  return shortest_least_squares(design, Eigen::VectorXd(norms(moved).array().log().matrix())).tail(d);
}

Eigen::MatrixXd few_of(const Eigen::MatrixXd& samples) {
  const Eigen::Index points = samples.rows() / 3, stride = std::max<Eigen::Index>(1, points / few_points) | 1;
  std::vector<Eigen::Index> rows;
  for (Eigen::Index point = 0; point < points; point += stride)
    for (Eigen::Index c = 0; c < 3; ++c) rows.push_back(3 * point + c);
  return samples(rows, Eigen::all);
}

}  // namespace

std::vector<int> representative_cases(const std::vector<RecordedParameters>& cases, int most) {
  const int n = static_cast<int>(cases.size());
  std::vector<int> list(cases.size());
  std::iota(list.begin(), list.end(), 0);
  if (n <= most) return list;
  const Features features(cases, Loading::general);
  Eigen::MatrixXd places(features.size(), n);
  for (int i = 0; i < n; ++i) places.col(i) = features.at(cases[i]);
  Eigen::VectorXd distances = Eigen::VectorXd::Constant(n, std::numeric_limits<double>::infinity());
  Eigen::Index next = 0;
  (places.colwise() - places.rowwise().mean()).colwise().squaredNorm().maxCoeff(&next);
  list.clear();
  while (static_cast<int>(list.size()) < most) {
    list.push_back(static_cast<int>(next));
    distances = distances.cwiseMin(
        (places.colwise() - Eigen::VectorXd(places.col(next))).colwise().squaredNorm().transpose());
    distances.maxCoeff(&next);
  }
  std::sort(list.begin(), list.end());
  return list;
}

std::vector<Loading> loadings_of(const RecordedParameters& p) {
  if (!is_linear_in_prestress(*p)) return {Loading::general};
  if (!p.texts().empty()) return {Loading::superposed};
  return {Loading::superposed, Loading::general};
}

DisplacementModel::DisplacementModel(const std::vector<RecordedParameters>& cases, const CaseSamples& samples,
                                     Loading loading)
    : features_(cases, loading),
      derivatives_(samples.derivatives.cols()),
      fitted_alike_(samples.fitted_alike) {
  const auto n = static_cast<Eigen::Index>(cases.size());
  places_.resize(n, features_.size()), loads_.resize(n, features_.load(cases[0]).size()), scales_.resize(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const RecordedParameters& one = cases[i];
    places_.row(i) = features_.at(one).transpose(), loads_.row(i) = features_.load(one).transpose();
    const double scale = features_.scale(one);
    scales_[i] = scale > 0 ? scale : 1;
  }
  const auto normal = [&] {
    return Eigen::MatrixXd(samples.displacements * scales_(samples.cases).cwiseInverse().asDiagonal());
  };
  if (!sees_curvature()) {
    const Covariance straight{"", 1,    Covariance::Correlation::none,
                              1,  1e-9, Eigen::VectorXd::Ones(features_.size())};
    TrainingCases plain = training(samples.cases, false);
    plain.gram = normal().transpose() * normal();
    plain_.emplace(Plain{
        samples.cases, scales_(samples.cases), {plain, straight}, few_of(samples.displacements), {}, {}});
  }
  const Eigen::VectorXd norms = samples.displacements.colwise().norm().transpose();
  exponents_ = exponents_of(places_(samples.cases, Eigen::all), norms.cwiseQuotient(scales_(samples.cases)));
  scales_.array() *= (places_ * exponents_).array().exp();
  add_ways(cases, samples);
  Eigen::MatrixXd data = normal();
  if (!ways_.empty()) {
    CLEFT_CHECK(samples.displacements.cols(), ==, n);
    Eigen::MatrixXd all(data.rows(), n + derivatives_);
    all << samples.displacements, samples.derivatives;
    data = to_rows(all);
  }
  choose(samples.cases, data);
  if (plain_ && uses_derivatives() && ways_see_all_features()) plain_.reset();
}

/// Derivatives by parameters that change what stays the same in all cases say nothing of what is between
/// them.
void DisplacementModel::add_ways(const std::vector<RecordedParameters>& cases, const CaseSamples& samples) {
  constexpr double nothing = 1e-9;  // of a change of the parameter by its step
  for (Eigen::Index d = 0; d < derivatives_; ++d) {
    const Eigen::Index of = samples.derivative_of[d];
    const RecordedParameters& one = cases[of];
    const std::string& name = samples.parameter[d];
    if (!one.number(name) || !(features_.scale(one) > 0)) continue;
    Way way{d, of, features_.slope(one, name), 0, 0};
    way.size = std::hypot(way.slope.features.norm(), way.slope.load.norm());
    if (way.slope.leaves || way.size * way.slope.step < nothing) continue;
    way.log_scale = way.slope.log_scale + exponents_.dot(way.slope.features);
    ways_.push_back(std::move(way));
  }
}

TrainingCases DisplacementModel::training(const std::vector<int>& cases, bool with_ways) const {
  TrainingCases training{places_(cases, Eigen::all), loads_(cases, Eigen::all), {}};
  training.fitted_alike = fitted_alike_;
  if (!with_ways) return training;
  const auto q = static_cast<Eigen::Index>(ways_.size());
  auto& slopes = training.slopes;
  slopes.features.resize(q, places_.cols()), slopes.loads.resize(q, loads_.cols());
  for (Eigen::Index w = 0; w < q; ++w) {
    const Way& way = ways_[w];
    slopes.of.push_back(way.of);
    slopes.features.row(w) = way.slope.features.transpose() / way.size;
    slopes.loads.row(w) = way.slope.load.transpose() / way.size;
  }
  return training;
}

void DisplacementModel::choose(const std::vector<int>& cases, const Eigen::MatrixXd& normal) {
  const auto n = static_cast<Eigen::Index>(cases.size());
  const Eigen::MatrixXd gram = normal.transpose() * normal;
  std::vector<KernelRegression> methods;
  for (const bool with_ways : {false, true}) {
    if (with_ways && ways_.empty()) continue;
    TrainingCases some = training(cases, with_ways);
    const Eigen::Index rows = n + (with_ways ? static_cast<Eigen::Index>(ways_.size()) : 0);
    some.gram = gram.topLeftCorner(rows, rows);
    for (KernelRegression& method : all_methods(some)) methods.push_back(std::move(method));
  }
  for (KernelRegression& regression : methods) {
    const KernelRegression::LeftOut left_out = regression.left_out();
    const Eigen::MatrixXd residuals = normal.leftCols(regression.rows()) * left_out.weights;
    Eigen::VectorXd errors(n), sizes(n);
    for (Eigen::Index i = 0; i < n; ++i) sizes[i] = largest_point(normal.col(i));
    const double least =
        std::max(least_size * std::sqrt(sizes.squaredNorm() / static_cast<double>(n)), 1e-300);
    std::vector<double> ratios;
    for (Eigen::Index i = 0; i < n; ++i) {
      const double residual = largest_point(residuals.col(i));
      errors[i] = residual / std::max(sizes[i], least);
      ratios.push_back(residual / left_out.deviations[i]);
    }
    const double error = std::sqrt(errors.squaredNorm() / static_cast<double>(n));
    if (regression_ && error >= left_out_error_) continue;
    regression_.emplace(std::move(regression));
    errors_ = errors, left_out_error_ = error;
    error_of_deviation_ = quantile(ratios, share_below_estimate);
  }
  if (plain_)
    plain_->chosen.emplace(*regression_), plain_->data = few_of(normal.leftCols(regression_->rows()));
  if (n == places_.rows()) return;
  std::vector<int> all(static_cast<std::size_t>(places_.rows()));
  std::iota(all.begin(), all.end(), 0);
  const Covariance chosen = regression_->covariance();
  regression_.emplace(training(all, false), chosen);
}

bool DisplacementModel::ways_see_all_features() const {
  Eigen::VectorXd seen = Eigen::VectorXd::Zero(places_.cols());
  for (const Way& way : ways_) seen = seen.cwiseMax(way.slope.features.cwiseAbs() / way.size);
  return seen.size() == 0 || seen.minCoeff() > 1e-3;
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

DisplacementModel::Points DisplacementModel::points_of(const std::vector<RecordedParameters>& list) const {
  const auto count = static_cast<Eigen::Index>(list.size());
  Points points{Eigen::MatrixXd(count, places_.cols()),
                Eigen::MatrixXd(count, loads_.cols()),
                Eigen::VectorXd(count),
                {}};
  for (Eigen::Index j = 0; j < count; ++j) {
    const RecordedParameters& one = list[static_cast<std::size_t>(j)];
    points.places.row(j) = features_.at(one).transpose(),
    points.loads.row(j) = features_.load(one).transpose();
    points.plain_scales[j] = features_.scale(one);
  }
  points.scales = points.plain_scales.array() * (points.places * exponents_).array().exp();
  return points;
}

Eigen::MatrixXd DisplacementModel::covariance(const std::vector<RecordedParameters>& list) const {
  const Points points = points_of(list);
  return points.scales.asDiagonal() * regression_->covariance_between(points.places, points.loads) *
         points.scales.asDiagonal();
}

/// Columns of displacements, and of derivatives behind them, as data of the regression's rows, d / scale,
/// whose derivative is that of d, and of the scale.
Eigen::MatrixXd DisplacementModel::to_rows(const Eigen::MatrixXd& data) const {
  const Eigen::Index n = places_.rows();
  Eigen::MatrixXd rows(data.rows(), n + static_cast<Eigen::Index>(ways_.size()));
  rows.leftCols(n) = data.leftCols(n) * scales_.cwiseInverse().asDiagonal();
  for (std::size_t w = 0; w < ways_.size(); ++w) {
    const Way& way = ways_[w];
    rows.col(n + static_cast<Eigen::Index>(w)) =
        (data.col(n + way.derivative) - way.log_scale * data.col(way.of)) / (scales_[way.of] * way.size);
  }
  return rows;
}

/// The transpose of that: weights of the rows as those of displacements and derivatives.
Eigen::MatrixXd DisplacementModel::from_rows(const Eigen::MatrixXd& weights) const {
  const Eigen::Index n = places_.rows();
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(n + derivatives_, weights.cols());
  all.topRows(n) = scales_.cwiseInverse().asDiagonal() * weights.topRows(n);
  for (Eigen::Index w = 0; w < weights.rows() - n; ++w) {
    const Way& way = ways_[static_cast<std::size_t>(w)];
    const Eigen::RowVectorXd weight = weights.row(n + w) / (scales_[way.of] * way.size);
    all.row(n + way.derivative) += weight;
    all.row(way.of) -= weight * way.log_scale;
  }
  return all;
}

Eigen::MatrixXd DisplacementModel::coefficients_of(const Eigen::MatrixXd& data) const {
  return regression_->coefficients(to_rows(data).leftCols(regression_->rows()));
}

Eigen::MatrixXd DisplacementModel::inverse() const {
  const Eigen::MatrixXd half = from_rows(regression_->inverse());
  return from_rows(half.transpose());
}

Eigen::MatrixXd DisplacementModel::sums(const Eigen::MatrixXd& coefficients,
                                        const std::vector<RecordedParameters>& list) const {
  const Points points = points_of(list);
  return regression_->sums(coefficients, points.places, points.loads) * points.scales.asDiagonal();
}

DisplacementModel::Predictions DisplacementModel::at(const std::vector<RecordedParameters>& list) const {
  const auto count = static_cast<Eigen::Index>(list.size()), n = places_.rows();
  const auto& [places, loads, plain_scales, scales] = points_of(list);
  const KernelRegression::Weights found = regression_->weights(places, loads);
  const Eigen::MatrixXd weights = from_rows(found.of_rows * scales.asDiagonal());
  Predictions all{
      weights.topRows(n), weights.bottomRows(derivatives_), scales.cwiseProduct(found.deviations), {}};
  if (plain_) {
    all.others.setZero(n, count);
    all.others(plain_->of, Eigen::all) = plain_->scales.cwiseInverse().asDiagonal() *
                                         plain_->regression.weights(places, loads).of_rows *
                                         plain_scales.asDiagonal();
  }
  return all;
}

DisplacementModel::Predictions DisplacementModel::left_out() const {
  const Eigen::Index n = places_.rows();
  const KernelRegression::LeftOut residuals = regression_->left_out();
  const Eigen::MatrixXd weights = -from_rows(residuals.weights * scales_.asDiagonal());
  Predictions all{
      weights.topRows(n), weights.bottomRows(derivatives_), scales_.cwiseProduct(residuals.deviations), {}};
  all.weights.diagonal().array() += 1;
  return all;
}

DisplacementModel::Prediction DisplacementModel::at(const RecordedParameters& parameters) const {
  const Predictions one = at(std::vector{parameters});
  Prediction prediction{one.weights.col(0), one.derivatives.col(0), error_of_deviation_ * one.deviations[0]};
  if (plain_) {  // then how far two models are apart says more
    const Eigen::MatrixXd place = features_.at(parameters).transpose(),
                          load = features_.load(parameters).transpose();
    const double scale = features_.scale(parameters) * std::exp(exponents_.dot(place.row(0)));
    const Eigen::VectorXd apart = scale * plain_->data * plain_->chosen->weights(place, load).of_rows.col(0) -
                                  plain_->samples * one.others.col(0)(plain_->of);
    prediction.error = std::hypot(prediction.error, largest_point(apart));
  }
  return prediction;
}

double DisplacementModel::outside(const RecordedParameters& parameters) const {
  const Eigen::VectorXd load = features_.load(parameters);
  Eigen::MatrixXd loads = loads_.transpose();
  if (uses_derivatives()) {
    loads.conservativeResize(Eigen::NoChange, loads.cols() + static_cast<Eigen::Index>(ways_.size()));
    for (std::size_t w = 0; w < ways_.size(); ++w)
      loads.col(loads_.rows() + static_cast<Eigen::Index>(w)) = ways_[w].slope.load / ways_[w].size;
  }
  const double unknown = (loads * shortest_least_squares(loads, load) - load).norm();
  const double distance =
      0.5 * std::hypot(distance_to_hull(places_, features_.at(parameters)), features_.off(parameters));
  return std::hypot(distance, unknown > 1e-6 ? unknown : 0);
}

DisplacementModel best_model(const std::vector<RecordedParameters>& cases, const CaseSamples& samples,
                             const std::vector<Loading>& loadings) {
  std::optional<DisplacementModel> best;
  for (const Loading loading : loadings) {
    DisplacementModel model(cases, samples, loading);
    if (!best || model.left_out_error() < 0.5 * best->left_out_error()) best.emplace(std::move(model));
  }
  return std::move(best).value();
}

}  // namespace cleft
