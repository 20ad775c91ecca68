#include "explorer/analysis/fit.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <openturns/ChiSquare.hxx>

#include "base/parallel.h"
#include "base/quantiles.h"

namespace cleft {

namespace {

constexpr double interval_over_deviation = 1.96;  // of an interval of 95 %
constexpr double of_largest = 3;         // the largest error of a field is about so many of its deviations
constexpr double hardly_told = 0.5;      // of the deviation before the measurements: what is left open
constexpr double takes_part = 0.35;      // of a direction of length 1
constexpr double bound_together = 0.95;  // a correlation
constexpr Eigen::Index looked_at = 400;  // draws

/// Every so many-th column, so that about `looked_at` remain.
Eigen::MatrixXd some_of(const Eigen::MatrixXd& points) {
  const Eigen::Index stride = std::max<Eigen::Index>(1, points.cols() / looked_at);
  Eigen::MatrixXd some(points.rows(), (points.cols() + stride - 1) / stride);
  for (Eigen::Index j = 0; j < some.cols(); ++j) some.col(j) = points.col(j * stride);
  return some;
}

std::string in_words(const std::vector<std::string>& names) {
  std::string text = names.front();
  for (std::size_t k = 1; k < names.size(); ++k) text += (k + 1 == names.size() ? " and " : ", ") + names[k];
  return text;
}

/// Sentences on directions in which the measurements leave much of the distributions open.
std::vector<std::string> left_open(const Eigen::MatrixXd& covariance,
                                   const std::vector<InputDistribution>& distributions) {
  constexpr double before = 1. / 12;  // variance of each coordinate of the cube
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(covariance);
  std::vector<std::string> sentences;
  std::vector<std::vector<std::string>> groups;
  for (Eigen::Index e = covariance.rows() - 1; e >= 0; --e) {
    if (solver.eigenvalues()[e] < hardly_told * hardly_told * before) continue;
    std::vector<std::string>& names = groups.emplace_back();
    for (Eigen::Index k = 0; k < covariance.rows(); ++k)
      if (std::abs(solver.eigenvectors()(k, e)) > takes_part)
        names.push_back(distributions[static_cast<std::size_t>(k)].name());
  }
  for (Eigen::Index a = 0; a < covariance.rows(); ++a)
    for (Eigen::Index b = 0; b < a; ++b)
      if (std::abs(covariance(a, b)) > bound_together * std::sqrt(covariance(a, a) * covariance(b, b)))
        groups.push_back({distributions[static_cast<std::size_t>(b)].name(),
                          distributions[static_cast<std::size_t>(a)].name()});
  for (std::vector<std::string>& names : groups) {
    if (names.empty()) continue;
    std::sort(names.begin(), names.end());
    const std::string sentence = names.size() == 1 ? "these data tell little of " + names.front()
                                                   : in_words(names) + " cannot be told apart by these data";
    if (std::find(sentences.begin(), sentences.end(), sentence) == sentences.end())
      sentences.push_back(sentence);
  }
  return sentences;
}

}  // namespace

MeasurementFit::MeasurementFit(const FigureModel& model, const Measurements& measurements,
                               const std::vector<InputDistribution>& distributions)
    : model_(model), measurements_(measurements), distributions_(distributions) {}

Eigen::MatrixXd MeasurementFit::values_at(const Eigen::MatrixXd& points) const {
  Eigen::MatrixXd values(points.rows(), points.cols());
  for (Eigen::Index j = 0; j < points.cols(); ++j)
    for (Eigen::Index k = 0; k < points.rows(); ++k)
      values(k, j) = distributions_[static_cast<std::size_t>(k)].quantile(points(k, j));
  return values;
}

FigureModel::Answers MeasurementFit::answers_at(const Eigen::MatrixXd& values) const {
  const Eigen::Index figures = std::ssize(measurements_.figures), forces = std::ssize(measurements_.forces);
  FigureModel::Answers answers{Eigen::MatrixXd(figures + forces, values.cols()),
                               Eigen::MatrixXd(figures + forces, values.cols())};
  if (figures > 0) {
    const FigureModel::Answers found = model_.at(values);
    answers.values.topRows(figures) = found.values, answers.errors.topRows(figures) = found.errors;
  }
  if (forces == 0) return answers;
  const std::vector<RecordedParameters> parameters = model_.parameters_at(values);
  parallel_for(static_cast<int>(values.cols()), [&](int j) {
    for (Eigen::Index f = 0; f < forces; ++f) {
      const SkinForce& force = measurements_.forces[static_cast<std::size_t>(f)];
      const double value = force.of(parameters[static_cast<std::size_t>(j)]);
      answers.values(figures + f, j) = value;
      answers.errors(figures + f, j) = force.relative_error() * std::abs(value);
    }
  });
  return answers;
}

Eigen::MatrixXd MeasurementFit::variances(const FigureModel::Answers& answers) const {
  Eigen::VectorXd own = measurements_.deviations.cwiseAbs2();
  for (Eigen::Index f = 0; f < std::ssize(measurements_.figures); ++f)
    if (const double fit = model_.fit_error(static_cast<int>(f)); std::isfinite(fit))
      own[f] += std::pow(fit / of_largest, 2);
  return (answers.errors / interval_over_deviation).cwiseAbs2().colwise() + own;
}

Eigen::VectorXd MeasurementFit::log_density(const Eigen::MatrixXd& points) const {
  const FigureModel::Answers answers = answers_at(values_at(points));
  const Eigen::ArrayXXd variance = variances(answers).array();
  const Eigen::ArrayXXd residuals = (-answers.values).array().colwise() + measurements_.values.array();
  return -0.5 * (residuals.square() / variance + variance.log()).colwise().sum().transpose();
}

ParameterFit MeasurementFit::find(const PosteriorSettings& settings) const {
  const auto dimension = static_cast<int>(distributions_.size());
  ParameterFit fit;
  fit.posterior = draw_posterior(
      dimension, [this](const Eigen::MatrixXd& points) { return log_density(points); }, settings);
  const Eigen::MatrixXd values = values_at(fit.posterior.points),
                        best = values_at(fit.posterior.most_likely());
  const Eigen::MatrixXd centred = values.colwise() - values.rowwise().mean();
  const Eigen::MatrixXd covariance = centred * centred.transpose() / static_cast<double>(values.cols());
  const Eigen::VectorXd deviations = covariance.diagonal().cwiseSqrt();
  fit.correlation =
      deviations.cwiseInverse().asDiagonal() * covariance * deviations.cwiseInverse().asDiagonal();
  const Eigen::MatrixXd in_cube = fit.posterior.covariance();
  for (Eigen::Index k = 0; k < dimension; ++k) {
    const std::vector<double> all(values.row(k).begin(), values.row(k).end());
    fit.parameters.push_back({distributions_[static_cast<std::size_t>(k)].name(), values.row(k).mean(),
                              deviations[k], quantile(all, 0.05), quantile(all, 0.95), best(k, 0),
                              std::max(0., 1 - std::sqrt(12 * in_cube(k, k)))});
  }
  fit.open = left_open(in_cube, distributions_);

  const FigureModel::Answers at_best = answers_at(best);
  fit.residuals = measurements_.values - at_best.values.col(0);
  const double squares = (fit.residuals.array().square() / variances(at_best).col(0).array()).sum();
  const auto count = static_cast<double>(fit.residuals.size());
  fit.misfit = std::sqrt(squares / count);
  fit.misfit_probability = OT::ChiSquare(count).computeComplementaryCDF(squares);

  // A simulation tells most where what is possible is predicted worst.
  const Eigen::MatrixXd some = some_of(values);
  const Eigen::MatrixXd errors = answers_at(some).errors;
  Eigen::Index worst = 0;
  (measurements_.deviations.cwiseInverse().asDiagonal() * errors).colwise().squaredNorm().maxCoeff(&worst);
  fit.next_case = some.col(worst);
  return fit;
}

NextMeasurement next_measurement(const FigureModel& candidates, const Eigen::MatrixXd& possible) {
  const Eigen::MatrixXd values = candidates.values()(some_of(possible));
  const Eigen::VectorXd spread = ((values.colwise() - values.rowwise().mean()).rowwise().squaredNorm() /
                                  static_cast<double>(values.cols()))
                                     .cwiseSqrt();
  NextMeasurement next;
  Eigen::Index best = 0;
  next.spread = spread.maxCoeff(&best), next.figure = static_cast<int>(best);
  return next;
}

}  // namespace cleft
