#include "explorer/analysis/wanted.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "params/parameters/table.h"

namespace cleft {

namespace {

constexpr std::size_t most_uncertain = 6;  // figures in a condition, whose errors are combined

std::vector<std::string> plain_names() {
  std::vector<std::string> names{"gape", "displacement"};
  for (const Parameter& p : parameter_table())
    if (!p.is_text()) names.push_back(p.name);
  return names;
}

}  // namespace

Wanted::Wanted(std::vector<Aim> aims, const std::string& condition, bool certain)
    : aims_(std::move(aims)), names_(plain_names()), certain_(certain) {
  if (!condition.empty()) condition_.emplace(Expression::with_calls(condition, names_));
  const std::size_t of_condition = names_.size();
  for (const Aim& aim : aims_)
    if (std::find(names_.begin(), names_.end(), aim.name) == names_.end()) names_.push_back(aim.name);
  const auto is_aim = [&](const std::string& name) {
    return std::any_of(aims_.begin(), aims_.end(), [&](const Aim& aim) { return aim.name == name; });
  };
  for (std::size_t n = 0; n < names_.size(); ++n) {
    const bool in_condition = n < of_condition && condition_ && condition_->uses(n),
               parameter = find_parameter(names_[n]) != nullptr;
    figure_of_name_.push_back(parameter || !(in_condition || is_aim(names_[n])) ? -1 : figure(names_[n]));
    if (in_condition && !parameter) uncertain_.push_back(n);
  }
  if (figures_.empty()) figures_.emplace_back("gape");  // a model has one at least
  if (uncertain_.size() > most_uncertain)
    throw InputError("condition '" + condition + "': has " + std::to_string(uncertain_.size()) +
                     " figures; at most " + std::to_string(most_uncertain) + " are combined");
}

int Wanted::figure(const std::string& text) {
  Figure one(text);
  if (one.is_field())
    throw InputError("figure 'field': is no number that can be compared; take displacement");
  figures_.push_back(std::move(one));
  return static_cast<int>(figures_.size()) - 1;
}

std::optional<int> Wanted::figure_of(const Aim& aim) const {
  const auto name = std::find(names_.begin(), names_.end(), aim.name);
  const int number = figure_of_name_[static_cast<std::size_t>(name - names_.begin())];
  return number < 0 ? std::nullopt : std::optional(number);
}

std::vector<double> Wanted::values_at(const FigureModel& model, const Eigen::VectorXd& point,
                                      const Eigen::VectorXd& figures) const {
  std::vector<double> values(names_.size(), std::nan(""));
  const RecordedParameters& constant = model.parameters_of(0);
  for (std::size_t n = 0; n < names_.size(); ++n)
    values[n] = figure_of_name_[n] >= 0 ? figures[figure_of_name_[n]]
                                        : constant.number(names_[n]).value_or(std::nan(""));
  for (std::size_t k = 0; k < model.varying().size(); ++k)
    if (const auto name = std::find(names_.begin(), names_.end(), model.varying()[k].name);
        name != names_.end())
      values[static_cast<std::size_t>(name - names_.begin())] = point[static_cast<Eigen::Index>(k)];
  return values;
}

/// The worst of all combinations of figures at the ends of their intervals.
double Wanted::excess_with_errors(std::vector<double> values, const Eigen::VectorXd& errors) const {
  const std::vector<double> middle = values;
  double worst = -HUGE_VAL;
  for (unsigned corner = 0; corner < 1U << uncertain_.size(); ++corner) {
    for (std::size_t k = 0; k < uncertain_.size(); ++k) {
      const std::size_t name = uncertain_[k];
      const double error = errors[figure_of_name_[name]];
      values[name] = middle[name] + ((corner >> k & 1U) != 0 ? error : -error);
    }
    worst = std::max(worst, condition_->excess(values));
  }
  return worst;
}

Wanted::Judged Wanted::judge(const FigureModel& model, const Eigen::MatrixXd& points,
                             const FigureModel::Answers& figures, bool with_errors) const {
  Judged judged{Eigen::MatrixXd(std::ssize(aims_), points.cols()), Eigen::VectorXd::Zero(points.cols())};
  for (Eigen::Index j = 0; j < points.cols(); ++j) {
    const std::vector<double> values = values_at(model, points.col(j), figures.values.col(j));
    for (std::size_t a = 0; a < aims_.size(); ++a) {
      const auto name = std::find(names_.begin(), names_.end(), aims_[a].name) - names_.begin();
      const double value = values[static_cast<std::size_t>(name)];
      if (std::isnan(value))
        throw InputError("aim '" + aims_[a].name + "': the study's cases do not record this parameter");
      judged.aims(static_cast<Eigen::Index>(a), j) = aims_[a].greatest ? -value : value;
    }
    if (condition_)
      judged.excess[j] =
          with_errors ? excess_with_errors(values, figures.errors.col(j)) : condition_->excess(values);
  }
  return judged;
}

Wanted::Judged Wanted::judge_cases(const FigureModel& model) const {
  Eigen::MatrixXd points(std::ssize(model.varying()), model.cases());
  FigureModel::Answers own{Eigen::MatrixXd(std::ssize(model.figures()), model.cases()), {}};
  for (int i = 0; i < model.cases(); ++i)
    points.col(i) = model.place_of(i), own.values.col(i) = model.figures_of(i);
  return judge(model, points, own, false);
}

namespace {

void round_whole_numbers(const FigureModel& model, Eigen::MatrixXd& points) {
  for (std::size_t k = 0; k < model.varying().size(); ++k)
    if (const Parameter* row = find_parameter(model.varying()[k].name); row && row->whole)
      points.row(static_cast<Eigen::Index>(k)) = points.row(static_cast<Eigen::Index>(k)).array().round();
}

}  // namespace

BestParameters best_parameters(const FigureModel& model, const Wanted& wanted) {
  const auto d = static_cast<Eigen::Index>(model.varying().size());
  BoxProblem problem{Eigen::VectorXd(d), Eigen::VectorXd(d), {}};
  for (Eigen::Index k = 0; k < d; ++k) {
    const FigureModel::Varied& one = model.varying()[static_cast<std::size_t>(k)];
    problem.least[k] = one.least, problem.greatest[k] = one.greatest;
  }
  const FigureModel::Function values = model.values();
  problem.at = [&](const Eigen::MatrixXd& unrounded) {
    Eigen::MatrixXd points = unrounded;
    round_whole_numbers(model, points);
    const FigureModel::Answers figures =
        wanted.needs_errors() ? model.at(points) : FigureModel::Answers{values(points), {}};
    const Wanted::Judged judged = wanted.judge(model, points, figures, wanted.needs_errors());
    return AimAndExcess{judged.aims.row(0).transpose(), judged.excess};
  };
  Eigen::MatrixXd starts(d, model.cases());
  for (int i = 0; i < model.cases(); ++i) starts.col(i) = model.place_of(i);
  const Optimum found = least_in_box(problem, starts);

  Eigen::MatrixXd point = found.point;
  round_whole_numbers(model, point);
  const FigureModel::Answers figures = model.at(point);
  return {point.col(0),
          figures.values.col(0),
          figures.errors.col(0),
          found.excess <= 0,
          wanted.judge(model, point, figures, true).excess[0] <= 0,
          found.evaluations};
}

std::vector<int> best_cases(const FigureModel& model, const Wanted& wanted) {
  const Wanted::Judged judged = wanted.judge_cases(model);
  std::vector<int> possible, best;
  for (int i = 0; i < model.cases(); ++i)
    if (judged.excess[i] <= 0) possible.push_back(i);
  for (const int k : unsurpassed(judged.aims(Eigen::all, possible)))
    best.push_back(possible[static_cast<std::size_t>(k)]);
  std::stable_sort(best.begin(), best.end(),
                   [&](int a, int b) { return judged.aims(0, a) < judged.aims(0, b); });
  return best;
}

}  // namespace cleft
