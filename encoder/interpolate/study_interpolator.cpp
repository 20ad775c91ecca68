#include "encoder/interpolate/study_interpolator.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "base/error.h"
#include "base/quantiles.h"
#include "base/text.h"
#include "encoder/interpolate/field_samples.h"
#include "params/consistency.h"
#include "params/parameters/table.h"

namespace cleft {

namespace {

std::vector<RecordedParameters> parameters_of(const CommonCases& cases) {
  std::vector<RecordedParameters> list;
  for (const CommonCase& one : cases.cases()) list.push_back(one.parameters);
  return list;
}

std::vector<FieldGeometry> geometries_of(const CommonCases& cases) {
  std::vector<FieldGeometry> list;
  for (const CommonCase& one : cases.cases()) list.push_back(one.geometry);
  return list;
}

constexpr int most_compared = 128;
constexpr double time_to_read = 0.4, time_to_sample = 0.3;  // of the whole, and of the rest

ReportPart share_of(const ReportPart& report, double begin, double end) {
  if (!report) return {};
  return [=](double part) { report(begin + part * (end - begin)); };
}

void join_groups(ParameterGroups& groups) {
  std::set<int> all(groups.together.cases.begin(), groups.together.cases.end());
  for (const ParameterGroup& one : groups.alone) all.insert(one.cases.begin(), one.cases.end());
  groups.together.cases.assign(all.begin(), all.end());
  groups.alone.clear();
}

/// Cases from which a model is made, and what some of them are compared by.
struct SampledCases {
  std::vector<RecordedParameters> parameters;
  CaseSamples samples;
};

/// If there are many cases, some determine the method and its error; and fields between them needs no
/// derivatives.
SampledCases sampled(const CommonCases& cases, const std::vector<RecordedParameters>& parameters,
                     const std::vector<int>& some, const CommonPlaces& places) {
  constexpr std::size_t most_rows = 512;
  SampledCases sampled;
  for (const int i : some) sampled.parameters.push_back(parameters[static_cast<std::size_t>(i)]);
  CaseSamples& samples = sampled.samples;
  samples.cases = representative_cases(sampled.parameters, most_compared);
  std::vector<int> compared;
  for (const int i : samples.cases) compared.push_back(some[static_cast<std::size_t>(i)]);
  samples.fitted_alike = cases.fitted_alike();
  samples.displacements = sample_cases(cases, places, compared);
  const std::size_t derivatives = cases.derivatives().size();
  if (derivatives == 0 || some.size() > most_compared || some.size() + derivatives > most_rows)
    return sampled;
  for (const CommonDerivative& one : cases.derivatives())
    samples.derivative_of.push_back(one.of), samples.parameter.push_back(one.parameter);
  samples.derivatives = sample_derivatives(cases, places);
  return sampled;
}

}  // namespace

StudyInterpolator::StudyInterpolator(const std::string& study, const ReportPart& report)
    : StudyInterpolator(CommonCases::of_study(study, share_of(report, 0, time_to_read)),
                        share_of(report, time_to_read, 1)) {}

StudyInterpolator::StudyInterpolator(CommonCases cases, const ReportPart& report)
    : cases_(std::move(cases)),
      parameters_(parameters_of(cases_)),
      geometry_(parameters_, geometries_of(cases_)) {
  for (const std::string& name : varying_parameters(parameters_)) {
    Range& range = varying_.emplace_back(Range{name, HUGE_VAL, -HUGE_VAL});
    for (const RecordedParameters& one : parameters_) {
      const double value = one.number(name).value();
      range.least = std::min(range.least, value), range.greatest = std::max(range.greatest, value);
    }
  }
  if (report) report(0);
  std::vector<Loading> loadings = loadings_of(parameters_.front());
  groups_ = parameter_groups(parameters_);
  // Where most parameters vary together and some alone, a model of all would have to tell from the latter's
  // few cases how the field changes with everything: what each of them changes is a model of its own.
  if (loadings.front() != Loading::superposed || !cases_.derivatives().empty()) join_groups(groups_);
  if (!groups_.alone.empty()) loadings = {Loading::superposed};
  const CommonPlaces places = places_in_common(cases_);
  const SampledCases together = sampled(cases_, parameters_, groups_.together.cases, places);
  if (report) report(time_to_sample);
  model_.emplace(best_model(together.parameters, together.samples, loadings));
  for (const ParameterGroup& one : groups_.alone) {
    const SampledCases some = sampled(cases_, parameters_, one.cases, places);
    alone_.emplace_back(some.parameters, some.samples, Loading::superposed);
  }
}

RecordedParameters StudyInterpolator::varied_in(const ParameterGroup& group,
                                                RecordedParameters parameters) const {
  for (const auto& [name, value] : groups_.base)
    if (std::find(group.names.begin(), group.names.end(), name) == group.names.end())
      parameters.set(name, value);
  return parameters;
}

DisplacementModel::Prediction StudyInterpolator::of_all(const std::vector<int>& cases,
                                                        const DisplacementModel::Prediction& of_some) const {
  DisplacementModel::Prediction all{Eigen::VectorXd::Zero(cases_.size()), {}, of_some.error};
  for (std::size_t k = 0; k < cases.size(); ++k)
    all.weights[cases[k]] = of_some.weights[static_cast<Eigen::Index>(k)];
  return all;
}

/// Neighbours are fitted alike, and so a field between them is as good as they are; where large weights of
/// either sign make it from differences of cases, their errors grow with them.
double StudyInterpolator::fit_error(const DisplacementModel::Prediction& prediction, double largest,
                                    double FitReport::*of_fit) const {
  std::vector<double> fits;
  double squares = 0;
  for (int i = 0; i < cases_.size(); ++i) {
    const FitReport& report = cases_.cases()[i].report;
    fits.push_back(std::isfinite(report.*of_fit) ? report.*of_fit : 0);
    squares += std::pow(prediction.weights[i] * fits.back() * report.largest_displacement, 2);
  }
  for (Eigen::Index d = 0; d < prediction.derivatives.size(); ++d)
    squares += std::pow(prediction.derivatives[d] * cases_.derivatives()[d].error, 2);
  return std::max(median(fits), largest > 0 ? std::sqrt(squares) / largest : 0);
}

/// Where cases on springs have one height, and those on bone others, the height tells which it is.
CaseParameters StudyInterpolator::with_bottom(CaseParameters values) const {
  const RecordedParameters& own = parameters_.front();
  const auto height = values.find(own.name_of(own->patch.height));
  const auto springs = groups_.base.find(own.name_of(own->patch.height));
  if (!groups_.base.contains(on_bone_name) || values.contains(on_bone_name) || height == values.end() ||
      springs == groups_.base.end())
    return values;
  values[on_bone_name] = height->second == springs->second ? 0 : 1;
  return values;
}

RecordedParameters StudyInterpolator::complete(const CaseParameters& given, bool meshable) const {
  const CaseParameters values = with_bottom(given);
  const auto list = [&] {
    std::string text;
    for (const Range& range : varying_)
      text += (text.empty() ? "" : ", ") + range.name + " (" + shortest(range.least) + " to " +
              shortest(range.greatest) + ")";
    return text;
  };
  RecordedParameters parameters = parameters_.front();
  std::vector<std::string> names;
  for (const auto& [name, value] : parameters.numbers()) names.push_back(name);
  // Switches and choices are known: then so is whether prestresses superpose.
  const bool superpose = features().loading() == Loading::superposed && !parameters.texts().empty();
  Mistakes mistakes;
  for (const auto& [name, value] : values)
    mistakes.collect([&, &n = name, v = value] {
      const std::optional<double> own = parameters.number(n);
      if (!own)
        throw InputError("unknown parameter '" + n + "'" + did_you_mean(n, names) + "; in this study vary " +
                         list());
      const Parameter* row = find_parameter(n);
      if (n == on_bone_name && v != 0 && v != 1)
        throw InputError(n + " = " + shortest(v) + ": must be 0, on springs, or 1, on bone");
      if (row)
        check_value(*row, v, "no such case");
      else if (!std::isfinite(v))
        throw InputError(n + " = " + shortest(v) + ": must be a number");
      const bool varies =
          std::any_of(varying_.begin(), varying_.end(), [&](const Range& r) { return r.name == n; });
      const bool superposes =
          superpose && row && is_prestress(parameters, row->address(*parameters)) && *own != 0;
      if (!varies && !superposes && v != *own)
        throw InputError(n + " = " + shortest(v) + ": it is " + shortest(*own) +
                         " in all cases; in this study vary " + list());
      parameters.set(n, v);
    });
  for (const Range& range : varying_)
    if (!values.contains(range.name))
      mistakes.add(range.name + " varies in this study, from " + shortest(range.least) + " to " +
                   shortest(range.greatest) + ": give its value too");
  mistakes.throw_if_any();

  Parameters whole;
  for (const auto& [name, value] : parameters.all())
    if (find_parameter(name)) set_parameter(whole, name, value, "no such case");
  if (meshable && parameters.has(parameters->cut.length) && parameters.has(parameters->patch.length))
    check_consistency(whole, "no such case");
  return parameters;
}

StudyInterpolator::Recipe StudyInterpolator::recipe(const CaseParameters& values, bool meshable) const {
  const RecordedParameters parameters = complete(values, meshable);
  if (alone_.empty()) return {parameters, model_->at(parameters), geometry_.at(parameters)};
  DisplacementModel::Prediction sum =
      of_all(groups_.together.cases, model_->at(varied_in(groups_.together, parameters)));
  const RecordedParameters base = varied_in({}, parameters);
  double squares = sum.error * sum.error;
  for (std::size_t k = 0; k < alone_.size(); ++k) {
    const ParameterGroup& group = groups_.alone[k];
    const RecordedParameters varied = varied_in(group, parameters);
    if (varied.numbers() == base.numbers()) continue;
    const auto changed = alone_[k].at(varied);
    sum.weights += of_all(group.cases, changed).weights - of_all(group.cases, alone_[k].at(base)).weights;
    squares += changed.error * changed.error;
  }
  sum.error = std::sqrt(squares);
  return {parameters, sum, geometry_.at(parameters)};
}

/// Of what varies together and of what varies alone, the farthest.
double StudyInterpolator::outside(const RecordedParameters& parameters) const {
  if (alone_.empty()) return model_->outside(parameters);
  double outside = model_->outside(varied_in(groups_.together, parameters));
  for (std::size_t k = 0; k < alone_.size(); ++k)
    outside = std::max(outside, alone_[k].outside(varied_in(groups_.alone[k], parameters)));
  return outside;
}

double StudyInterpolator::estimated_error(const Recipe& recipe, double largest,
                                          double FitReport::*of_fit) const {
  const double error = largest > 0 ? recipe.prediction.error / largest : 0;
  return std::hypot(error, fit_error(recipe.prediction, largest, of_fit));
}

void StudyInterpolator::tell(Field& field, const Recipe& recipe, double largest) const {
  const double error = largest > 0 ? recipe.prediction.error / largest : 0;
  field.parameters = recipe.parameters;
  name_bottom(field.parameters);
  field.interpolation = {regression().covariance().name, static_cast<double>(cases_.size()),
                         estimated_error(recipe, largest), error, outside(recipe.parameters)};
  const double none = std::nan("");
  field.report = {none, none, none, none, none, none, none, none,
                  none, none, none, none, none, none, none, none};
  field.report.node_error = field.report.spline_error = field.interpolation->estimated_error;
  field.report.largest_displacement = largest;
}

Field StudyInterpolator::at(const CaseParameters& values) const { return field_of(recipe(values)); }

Field StudyInterpolator::field_of(const Recipe& recipe) const {
  const auto& [weights, derivatives, error] = recipe.prediction;
  std::vector<Summand> summands;
  summands.reserve(static_cast<std::size_t>(weights.size() + derivatives.size()));
  for (int i = 0; i < cases_.size(); ++i) summands.push_back({weights[i], cases_.control_points(i)});
  for (Eigen::Index d = 0; d < derivatives.size(); ++d)
    summands.push_back({derivatives[d], cases_.derivative_points(static_cast<std::size_t>(d))});

  Field field = cases_.field_of(sum_of(summands), recipe.geometry);
  const CommonCase& first = cases_.cases().front();
  tell(field, recipe,
       largest_displacement(field, sample_places(field.parametrization().geometry(),
                                                 node_spacing(first.parameters, first.geometry))));
  return field;
}

}  // namespace cleft
