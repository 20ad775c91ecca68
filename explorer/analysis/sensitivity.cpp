#include "explorer/analysis/sensitivity.h"

#include <algorithm>
#include <cmath>
#include <openturns/ComposedDistribution.hxx>
#include <openturns/JansenSensitivityAlgorithm.hxx>
#include <openturns/MauntzKucherenkoSensitivityAlgorithm.hxx>
#include <openturns/ResourceMap.hxx>
#include <openturns/SobolIndicesExperiment.hxx>

#include "base/error.h"
#include "base/quantiles.h"

namespace cleft {

namespace {

constexpr int places = 21, averaged = 64;  // of a main effect

OT::ComposedDistribution joint(const std::vector<InputDistribution>& distributions) {
  OT::ComposedDistribution::DistributionCollection laws;
  for (const InputDistribution& one : distributions) laws.add(one.law());
  return OT::ComposedDistribution(laws);
}

Eigen::MatrixXd columns_of(const OT::Sample& sample) {
  Eigen::MatrixXd columns(static_cast<Eigen::Index>(sample.getDimension()),
                          static_cast<Eigen::Index>(sample.getSize()));
  for (Eigen::Index j = 0; j < columns.cols(); ++j)
    for (Eigen::Index k = 0; k < columns.rows(); ++k)
      columns(k, j) = sample(static_cast<OT::UnsignedInteger>(j), static_cast<OT::UnsignedInteger>(k));
  return columns;
}

/// Total indices, first ones from differences (Jansen), and from products (Mauntz and Kucherenko), one after
/// another, and their errors by the finite sample.
struct Indices {
  Eigen::VectorXd values, errors;
};
Indices indices_of(const OT::Sample& points, const Eigen::VectorXd& values, int size) {
  OT::Sample out(static_cast<OT::UnsignedInteger>(values.size()), 1);
  for (Eigen::Index j = 0; j < values.size(); ++j)
    out(static_cast<OT::UnsignedInteger>(j), 0) = values[j] - values.mean();
  OT::JansenSensitivityAlgorithm differences(points, out, static_cast<OT::UnsignedInteger>(size));
  OT::MauntzKucherenkoSensitivityAlgorithm products(points, out, static_cast<OT::UnsignedInteger>(size));
  differences.setUseAsymptoticDistribution(true), products.setUseAsymptoticDistribution(true);
  const auto dimension = static_cast<Eigen::Index>(points.getDimension());
  Indices indices{Eigen::VectorXd(3 * dimension), Eigen::VectorXd(3 * dimension)};
  const auto add = [&](Eigen::Index begin, const OT::Point& found, const OT::Interval& within) {
    for (Eigen::Index k = 0; k < dimension; ++k) {
      const auto at = static_cast<OT::UnsignedInteger>(k);
      indices.values[begin + k] = found[at];
      indices.errors[begin + k] = 0.5 * (within.getUpperBound()[at] - within.getLowerBound()[at]);
    }
  };
  add(0, differences.getTotalOrderIndices(), differences.getTotalOrderIndicesInterval());
  add(dimension, differences.getFirstOrderIndices(), differences.getFirstOrderIndicesInterval());
  add(2 * dimension, products.getFirstOrderIndices(), products.getFirstOrderIndicesInterval());
  return indices;
}

/// The other parameters as they were drawn, one at the given places.
std::vector<double> main_effect(const FigureFunction& figure, const Eigen::MatrixXd& drawn, Eigen::Index k,
                                const std::vector<double>& at) {
  const Eigen::Index others = std::min<Eigen::Index>(averaged, drawn.cols());
  Eigen::MatrixXd points(drawn.rows(), others * std::ssize(at));
  for (Eigen::Index p = 0; p < std::ssize(at); ++p) {
    points.middleCols(p * others, others) = drawn.leftCols(others);
    points.row(k).segment(p * others, others).setConstant(at[static_cast<std::size_t>(p)]);
  }
  const Eigen::VectorXd values = figure(points);
  std::vector<double> means;
  for (Eigen::Index p = 0; p < std::ssize(at); ++p)
    means.push_back(values.segment(p * others, others).mean());
  return means;
}

}  // namespace

double jackknife_error(const Eigen::VectorXd& values) {
  constexpr double of_deviation = 1.96;  // half a 95 % interval of a normal distribution
  const auto n = static_cast<double>(values.size());
  if (n < 2) return 0;
  return of_deviation * std::sqrt((values.array() - values.mean()).square().sum() * (n - 1) / n);
}

Sensitivities sensitivities_of(const std::vector<InputDistribution>& distributions,
                               const FigureFunction& figure, const AlternativeFigures& alternatives,
                               int size) {
  OT::ResourceMap::SetAsString("SobolIndicesExperiment-SamplingMethod", "QMC");
  const OT::Sample sample =
      OT::SobolIndicesExperiment(joint(distributions), static_cast<OT::UnsignedInteger>(size)).generate();
  const Eigen::MatrixXd points = columns_of(sample);
  const Eigen::VectorXd values = figure(points);
  const auto dimension = static_cast<Eigen::Index>(distributions.size());

  Sensitivities result;
  result.evaluations = static_cast<int>(points.cols());
  result.points = points.leftCols(2 * size), result.values = values.head(2 * size);
  result.mean = result.values.mean();
  result.deviation = std::sqrt((result.values.array() - result.mean).square().mean());
  if (!(result.deviation > 1e-12 * std::abs(result.mean)))
    throw InputError("the figure is the same for all values of the parameters: nothing has an effect on it");
  for (const double part : {0.025, 0.25, 0.5, 0.75, 0.975}) {
    result.parts.push_back(part);
    result.quantiles.push_back(quantile({result.values.begin(), result.values.end()}, part));
  }

  const Indices indices = indices_of(sample, values, size);
  const Eigen::MatrixXd figures = alternatives ? alternatives(points) : Eigen::MatrixXd(0, points.cols());
  Eigen::MatrixXd others(indices.values.size(), figures.rows());
  for (Eigen::Index a = 0; a < others.cols(); ++a)
    others.col(a) = indices_of(sample, figures.row(a).transpose(), size).values;
  const auto estimate = [&](Eigen::Index at) {
    return Estimate{std::clamp(indices.values[at], 0., 1.),
                    std::hypot(indices.errors[at], jackknife_error(others.row(at).transpose()))};
  };
  for (Eigen::Index k = 0; k < dimension; ++k) {
    ParameterEffect& effect = result.parameters.emplace_back();
    // Of large indices differences are surer, of small ones products.
    const Estimate by_differences = estimate(dimension + k), by_products = estimate(2 * dimension + k);
    effect.first = by_differences.error < by_products.error ? by_differences : by_products;
    effect.total = estimate(k);
    for (int p = 0; p < places; ++p)
      effect.at.push_back(
          distributions[static_cast<std::size_t>(k)].quantile(0.025 + 0.95 * p / (places - 1)));
    effect.mean = main_effect(figure, points, k, effect.at);
  }
  return result;
}

}  // namespace cleft
