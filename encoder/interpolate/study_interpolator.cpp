#include "encoder/interpolate/study_interpolator.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/text.h"
#include "encoder/interpolate/convex_hull.h"
#include "encoder/interpolate/field_samples.h"
#include "params/parameters.h"

namespace cleft {

namespace {

// Of the ratios of residual and deviation, cases left out: most cases in between then lie below the estimate.
constexpr double share_below_estimate = 0.95;

std::vector<CaseParameters> parameters_of(const CommonCases& cases) {
  std::vector<CaseParameters> list;
  for (const CommonCase& one : cases.cases()) list.push_back(one.parameters);
  return list;
}

std::vector<FieldGeometry> geometries_of(const CommonCases& cases) {
  std::vector<FieldGeometry> list;
  for (const CommonCase& one : cases.cases()) list.push_back(one.geometry);
  return list;
}

/// mm: of the solver's meshes; a guess for those of others.
double node_spacing(const CommonCase& one) {
  const auto size = one.parameters.find("mesh.element_size");
  if (size != one.parameters.end()) return size->second;
  const auto [front, back] = one.geometry.domain[0];
  return (one.geometry.cut.length > 0 ? one.geometry.cut.length : back - front) / 24;
}

double quantile(std::vector<double> values, double share) {
  const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1) + 0.5);
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[static_cast<std::size_t>(at)];
}

/// Largest norm of the points (x, y, z one after another) in a column.
double largest_point(const Eigen::Ref<const Eigen::VectorXd>& column) {
  return Eigen::Map<const Eigen::Matrix3Xd>(column.data(), 3, column.size() / 3).colwise().norm().maxCoeff();
}

/// What is known of the prestress: it superposes, it does not, or the data must say.
std::vector<Loading> loadings_of(const CommonCases& cases) {
  const auto& choices = cases.choices();
  const auto is = [&](const char* name, const char* value) {
    const auto found = choices.find(name);
    return found != choices.end() && found->second == value;
  };
  if (is("cut.contact", "true") || is("skin.initial_stress_stiffness", "true")) return {Loading::general};
  if (!choices.empty()) return {Loading::superposed};
  return {Loading::superposed, Loading::general};
}

/// Exponents of the power law in the features that fits the columns' norms best.
Eigen::VectorXd exponents_of(const Eigen::MatrixXd& places, const Eigen::VectorXd& norms) {
  const Eigen::Index n = places.rows(), d = places.cols();
  if (n < d + 2 || norms.minCoeff() <= 0) return Eigen::VectorXd::Zero(d);
  Eigen::MatrixXd design(n, d + 1);
  design << Eigen::VectorXd::Ones(n), places;
  return design.completeOrthogonalDecomposition().solve(norms.array().log().matrix().eval()).tail(d);
}

}  // namespace

StudyInterpolator::StudyInterpolator(const std::string& study)
    : StudyInterpolator(CommonCases(read_members(study))) {}

StudyInterpolator::StudyInterpolator(CommonCases cases)
    : cases_(std::move(cases)),
      parameters_(parameters_of(cases_)),
      geometry_(parameters_, geometries_of(cases_)) {
  for (const std::string& name : varying_parameters(parameters_)) {
    Range& range = varying_.emplace_back(Range{name, parameters_[0].at(name), parameters_[0].at(name)});
    for (const CaseParameters& one : parameters_)
      range.least = std::min(range.least, one.at(name)),
      range.greatest = std::max(range.greatest, one.at(name));
  }
  const FieldGeometry& body = cases_.cases().front().geometry;
  const Eigen::MatrixXd samples =
      sample_cases(cases_, body, sample_places(body, node_spacing(cases_.cases().front())));
  for (const Loading loading : loadings_of(cases_)) {
    Model model = model_of(cases_, samples, loading);
    if (!model_ || model.score < model_->score) model_.emplace(std::move(model));
  }
  std::vector<double> fits;
  for (const CommonCase& one : cases_.cases())
    fits.push_back(std::isfinite(one.report.spline_error) ? one.report.spline_error : 0);
  fit_error_ = quantile(fits, 0.5);
}

StudyInterpolator::Model StudyInterpolator::model_of(const CommonCases& cases, const Eigen::MatrixXd& samples,
                                                     Loading loading) {
  const std::vector<CaseParameters> parameters = parameters_of(cases);
  Features features(parameters, loading);
  const Eigen::Index n = cases.size();
  Eigen::MatrixXd places(n, features.size()), loads(n, features.load(parameters[0]).size());
  Eigen::VectorXd scales(n), norms = samples.colwise().norm();
  for (Eigen::Index i = 0; i < n; ++i) {
    const CaseParameters& one = parameters[static_cast<std::size_t>(i)];
    places.row(i) = features.at(one).transpose(), loads.row(i) = features.load(one).transpose();
    const double scale = features.scale(one);
    scales[i] = scale > 0 ? scale : 1;
  }
  const Eigen::VectorXd exponents = exponents_of(places, norms.cwiseQuotient(scales));
  scales.array() *= (places * exponents).array().exp();

  const Eigen::MatrixXd normal = samples * scales.cwiseInverse().asDiagonal();
  const TrainingCases training{places, loads, normal.transpose() * normal};
  std::optional<Model> best;
  for (KernelRegression& regression : all_methods(training)) {
    const Eigen::MatrixXd residuals = normal * regression.left_out();
    Eigen::VectorXd errors(n);
    std::vector<double> ratios;
    for (Eigen::Index i = 0; i < n; ++i) {
      const double residual = largest_point(residuals.col(i));
      errors[i] = residual / std::max(largest_point(normal.col(i)), 1e-300);
      ratios.push_back(residual / regression.left_out_deviation()[i]);
    }
    const double score = std::sqrt(errors.squaredNorm() / static_cast<double>(n));
    if (!best || score < best->score)
      best.emplace(Model{features, places, exponents, scales, std::move(regression), errors,
                         quantile(ratios, share_below_estimate), score});
  }
  return std::move(*best);
}

CaseParameters StudyInterpolator::complete(const CaseParameters& values) const {
  const auto list = [&] {
    std::string text;
    for (const Range& range : varying_)
      text += (text.empty() ? "" : ", ") + range.name + " (" + shortest(range.least) + " to " +
              shortest(range.greatest) + ")";
    return text;
  };
  CaseParameters parameters = parameters_.front();
  std::vector<std::string> names;
  for (const auto& [name, value] : parameters) names.push_back(name);
  const auto known = parameter_names();
  Mistakes mistakes;
  for (const auto& [name, value] : values)
    mistakes.collect([&, &n = name, v = value] {
      const auto found = parameters.find(n);
      if (found == parameters.end())
        throw InputError("unknown parameter '" + n + "'" + did_you_mean(n, names) + "; in this study vary " +
                         list());
      if (std::find(known.begin(), known.end(), n) != known.end())
        check_value(find_parameter(n, n), v, "no such case");
      else if (!std::isfinite(v))
        throw InputError(n + " = " + shortest(v) + ": must be a number");
      const bool varies =
          std::any_of(varying_.begin(), varying_.end(), [&](const Range& r) { return r.name == n; });
      const bool superposes = n.starts_with("skin.prestress_") && found->second != 0 &&
                              features().loading() == Loading::superposed && !cases_.choices().empty();
      if (!varies && !superposes && v != found->second)
        throw InputError(n + " = " + shortest(v) + ": it is " + shortest(found->second) +
                         " in all cases; in this study vary " + list());
      found->second = v;
    });
  for (const Range& range : varying_)
    if (!values.contains(range.name))
      mistakes.add(range.name + " varies in this study, from " + shortest(range.least) + " to " +
                   shortest(range.greatest) + ": give its value too");
  mistakes.throw_if_any();

  Parameters whole;
  for (const auto& [name, value] : parameters)
    if (std::find(known.begin(), known.end(), name) != known.end())
      set_parameter(whole, name, value, "no such case");
  if (parameters.contains("cut.length") && parameters.contains("patch.length"))
    check_consistency(whole, "no such case");
  return parameters;
}

double StudyInterpolator::outside(const CaseParameters& parameters) const {
  const Eigen::VectorXd load = features().load(parameters);
  Eigen::MatrixXd loads(load.size(), cases_.size());
  for (Eigen::Index i = 0; i < loads.cols(); ++i)
    loads.col(i) = features().load(parameters_[static_cast<std::size_t>(i)]);
  const double unknown = (loads * loads.completeOrthogonalDecomposition().solve(load) - load).norm();
  // From -1 to 1 is one spread.
  const double distance = 0.5 * std::hypot(distance_to_hull(model_->places, features().at(parameters)),
                                           features().off(parameters));
  return std::hypot(distance, unknown > 1e-6 ? unknown : 0);
}

Field StudyInterpolator::at(const CaseParameters& values) const {
  const CaseParameters parameters = complete(values);
  const Model& model = *model_;
  const Eigen::VectorXd place = model.features.at(parameters), load = model.features.load(parameters);
  const double scale = model.features.scale(parameters) * std::exp(model.exponents.dot(place));
  const Eigen::VectorXd weights = model.regression.weights(place, load);

  // Sums in the same order for every point: control points that are one in all cases stay one, bit for bit.
  std::vector<double> sum(cases_.control_points(0).size(), 0);
  for (int i = 0; i < cases_.size(); ++i) {
    const double weight = weights[i] * scale / model.scales[i];
    const std::span<const float> points = cases_.control_points(i);
    for (std::size_t n = 0; n < sum.size(); ++n) sum[n] += weight * static_cast<double>(points[n]);
  }
  std::vector<Vec3> points(sum.size() / 3);
  for (std::size_t n = 0; n < sum.size(); ++n) points[n / 3][static_cast<int>(n % 3)] = sum[n];

  Field field = cases_.field_of(points, geometry_.at(parameters));
  const double largest = largest_displacement(
      field, sample_places(field.parametrization().geometry(), node_spacing(cases_.cases().front())));
  const double error =
      largest > 0 ? model.error_of_deviation * model.regression.deviation(place, load) * scale / largest : 0;
  field.parameters = parameters;
  field.interpolation = {model.regression.covariance().name, static_cast<double>(cases_.size()),
                         std::hypot(error, fit_error_), error, outside(parameters)};
  const double none = std::nan("");
  field.report = {none, none, none, none, none, none, none, none, none, none, none, none, none, none, none};
  field.report.node_error = field.report.spline_error = field.interpolation->estimated_error;
  field.report.largest_displacement = largest;
  return field;
}

}  // namespace cleft
