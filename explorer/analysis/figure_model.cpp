#include "explorer/analysis/figure_model.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "base/error.h"
#include "base/parallel.h"
#include "base/quantiles.h"
#include "explorer/study/case_figures.h"
#include "params/parameters/lip_formulation.h"

namespace cleft {

namespace {

constexpr std::size_t few_cases = 64;  // whose quantiles are those of a normal distribution, and whose method
                                       // is chosen again without each part of them if they, with their
                                       // derivatives, are as few
constexpr int most_parts = 8;
constexpr int most_compared = 128;            // cases that choose the method
constexpr Eigen::Index most_data = 512;       // with derivatives, which more cases need not
constexpr Eigen::Index points_at_once = 256;  // their weights stay in the cache

Eigen::VectorXd displacements_of(const Field& field, const std::vector<Figure>& figures) {
  Eigen::VectorXd all;
  for (const Figure& figure : figures) {
    const Eigen::VectorXd own = figure.displacements(field);
    all.conservativeResize(all.size() + own.size());
    all.tail(own.size()) = own;
  }
  return all;
}

void check_choices(const RecordedParameters& a, const RecordedParameters& b) {
  const auto texts = a.texts(), others = b.texts();
  const auto found = std::find_if(others.begin(), others.end(), [&](const auto& other) {
    const auto own = texts.find(other.first);
    return own != texts.end() && own->second != other.second && other.first != formulation_name;
  });
  if (found == others.end()) return;
  const auto& [name, value] = *found;
  throw InputError("the cases differ in " + name + " (\"" + texts.at(name) + "\" and \"" + value +
                   "\"), between which nothing lies; make a study of each");
}

/// Of equal parameters the case that was read last.
FigureModel::Cases read_cases(const PublishedStudy& study, const std::vector<Figure>& figures,
                              const ReportPart& report) {
  std::map<std::map<std::string, double>, int> of_numbers;
  FigureModel::Cases cases;
  std::vector<Eigen::VectorXd> columns, slopes, errors;
  for (int i = 0; i < study.size(); ++i) {
    if (report) report(1. * i / study.size());
    const Field field = study.read(i);
    RecordedParameters parameters = parameters_as_solved(field);
    for (const auto& [name, value] : study.parameters(i).texts()) parameters.set(name, value);
    if (!of_numbers.emplace(parameters.numbers(), i).second) continue;
    if (!cases.parameters.empty()) check_choices(cases.parameters.front(), parameters);
    cases.parameters.push_back(parameters);
    cases.numbers.push_back(i);
    for (const ParameterDerivative& one : field.by_parameter) {
      const Field slope(field.shared_parametrization(),
                        {field.basis(0), field.basis(1), field.basis(2), field.basis(3)}, one.control_points);
      cases.derivative_of.push_back(static_cast<int>(columns.size())), cases.by.push_back(one.parameter);
      slopes.push_back(displacements_of(slope, figures));
    }
    columns.push_back(displacements_of(field, figures));
    errors.emplace_back(Eigen::VectorXd::Constant(static_cast<Eigen::Index>(figures.size()),
                                                  error_of_gape(field).value_or(std::nan(""))));
  }
  if (columns.size() < 3)
    throw InputError(study.path() + ": holds " + std::to_string(columns.size()) +
                     (columns.size() == 1 ? " case" : " cases of different parameters") +
                     "; at least three are needed");
  cases.displacements.resize(columns.front().size(), std::ssize(columns));
  cases.fit_errors.resize(errors.front().size(), std::ssize(errors));
  for (std::size_t i = 0; i < columns.size(); ++i)
    cases.displacements.col(static_cast<Eigen::Index>(i)) = columns[i],
    cases.fit_errors.col(static_cast<Eigen::Index>(i)) = errors[i];
  cases.derivatives.resize(columns.front().size(), std::ssize(slopes));
  for (std::size_t d = 0; d < slopes.size(); ++d)
    cases.derivatives.col(static_cast<Eigen::Index>(d)) = slopes[d];
  return cases;
}

/// What a new value of the same kind keeps with a probability of `share`: between two of many values. Of few
/// values that quantile is one of the largest, by chance: theirs is taken from a normal distribution of their
/// mean square.
double kept(std::vector<double> values, double share) {
  const auto n = static_cast<double>(values.size());
  if (values.size() > few_cases) {
    const double rank = (n + 1) * share - 1;
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(rank);
    std::nth_element(values.begin(), at, values.end());
    return *at + (rank - std::floor(rank)) * (*std::min_element(at + 1, values.end()) - *at);
  }
  double squares = 0;
  for (const double value : values) squares += value * value;
  return (1.96 + 2.37 / n + 2.82 / (n * n)) * std::sqrt(squares / n);  // of Student's distribution, expanded
}

/// Of some of the cases. Of many, a part chooses the method.
DisplacementModel best_model(const FigureModel::Cases& cases, const std::vector<int>& some) {
  std::vector<RecordedParameters> parameters;
  std::vector<int> place(cases.parameters.size(), -1);
  for (const int i : some) {
    place[static_cast<std::size_t>(i)] = static_cast<int>(parameters.size());
    parameters.push_back(cases.parameters[static_cast<std::size_t>(i)]);
  }
  CaseSamples samples;
  samples.cases = representative_cases(parameters, most_compared);
  std::vector<int> compared, slopes;
  for (const int i : samples.cases) compared.push_back(some[static_cast<std::size_t>(i)]);
  samples.displacements = cases.displacements(Eigen::all, compared);
  for (std::size_t d = 0; d < cases.by.size(); ++d)
    if (const int of = place[static_cast<std::size_t>(cases.derivative_of[d])]; of >= 0)
      samples.derivative_of.push_back(of), samples.parameter.push_back(cases.by[d]),
          slopes.push_back(static_cast<int>(d));
  samples.derivatives = cases.derivatives(Eigen::all, slopes);
  return best_model(parameters, samples, loadings_of(parameters.front()));
}

}  // namespace

FigureModel::FigureModel(const PublishedStudy& study, const std::vector<Figure>& figures,
                         const ReportPart& report)
    : FigureModel(read_cases(study, figures, report), figures) {}

FigureModel::FigureModel(Cases cases, std::vector<Figure> figures)
    : cases_(std::move(cases)), figures_(std::move(figures)) {
  const std::vector<RecordedParameters>& parameters = cases_.parameters;
  const Eigen::Index n = std::ssize(parameters);
  for (const std::string& name : varying_parameters(parameters)) {
    Varied& one = varying_.emplace_back(Varied{name, HUGE_VAL, -HUGE_VAL});
    places_.conservativeResize(std::ssize(varying_), n);
    for (Eigen::Index i = 0; i < n; ++i) {
      const double value = parameters[static_cast<std::size_t>(i)].number(name).value();
      places_(places_.rows() - 1, i) = value;
      one.least = std::min(one.least, value), one.greatest = std::max(one.greatest, value);
    }
  }
  if (varying_.empty()) throw InputError("no parameter varies in this study: there is nothing to ask");
  rows_ = {0};
  for (const Figure& figure : figures_)
    rows_.push_back(rows_.back() + 3 * std::ssize(figure.places(FieldGeometry{})));

  const Eigen::Index slopes = cases_.derivatives.cols();
  if (slopes == 0 || n > most_compared || n + slopes > most_data)
    cases_.derivatives.resize(cases_.displacements.rows(), 0), cases_.derivative_of.clear(),
        cases_.by.clear();
  std::vector<int> all(static_cast<std::size_t>(n));
  std::iota(all.begin(), all.end(), 0);
  model_ = std::make_shared<const DisplacementModel>(best_model(cases_, all));
  data_.resize(cases_.displacements.rows(), n + cases_.derivatives.cols());
  data_ << cases_.displacements, cases_.derivatives;
  own_ = figures_from(cases_.displacements);
  inverse_ = model_->inverse();
  residuals_.setZero(data_.rows(), data_.cols());
  for (int i = 0; i < n; ++i) {
    const std::vector<Eigen::Index> columns = columns_of({i});
    const Eigen::MatrixXd own = inverse_(columns, columns);
    residuals_(Eigen::all, columns) =
        own.ldlt().solve((data_ * inverse_(Eigen::all, columns)).transpose()).transpose();
  }
  const Eigen::MatrixXd predicted = cases_.displacements - residuals_.leftCols(n);
  left_out_ = figures_from(predicted);
  ratios_ = data_.cols() > static_cast<Eigen::Index>(few_cases)
                ? ratios_of(predicted, model_->left_out().deviations)
                : ratios_of(predicted_by_parts(), deviations_without_parts());
}

/// Of the data, and of their inverse covariance: those of cases, and of their derivatives that are used.
std::vector<Eigen::Index> FigureModel::columns_of(const std::vector<int>& cases) const {
  std::vector<Eigen::Index> columns(cases.begin(), cases.end());
  for (std::size_t d = 0; d < cases_.by.size(); ++d) {
    const Eigen::Index column = this->cases() + static_cast<Eigen::Index>(d);
    if (inverse_(column, column) > 0 &&
        std::find(cases.begin(), cases.end(), cases_.derivative_of[d]) != cases.end())
      columns.push_back(column);
  }
  return columns;
}

/// Residuals of predictions over their deviations.
Eigen::MatrixXd FigureModel::ratios_of(const Eigen::MatrixXd& predicted,
                                       const Eigen::VectorXd& deviations) const {
  return differences(predicted, cases_.displacements).cwiseAbs() * deviations.cwiseInverse().asDiagonal();
}

/// The method and its lengths are those that predict the cases left out best, which few cases may do by
/// chance: then each part of them is predicted by a method that was chosen without it.
Eigen::MatrixXd FigureModel::predicted_by_parts() const {
  const int parts = std::min(most_parts, cases());
  Eigen::MatrixXd predicted(cases_.displacements.rows(), cases());
  parallel_for(parts, [&](int part) {
    std::vector<int> left, rest;
    for (int i = 0; i < cases(); ++i) (i % parts == part ? left : rest).push_back(i);
    std::vector<RecordedParameters> of_left;
    of_left.reserve(left.size());
    for (const int i : left) of_left.push_back(cases_.parameters[static_cast<std::size_t>(i)]);
    const DisplacementModel model = best_model(cases_, rest);
    const DisplacementModel::Predictions found = model.at(of_left);
    std::vector<int> slopes;  // of the rest, in their order
    for (std::size_t d = 0; d < cases_.by.size(); ++d)
      if (cases_.derivative_of[d] % parts != part) slopes.push_back(static_cast<int>(d));
    predicted(Eigen::all, left) = cases_.displacements(Eigen::all, rest) * found.weights +
                                  cases_.derivatives(Eigen::all, slopes) * found.derivatives;
  });
  return predicted;
}

/// Standard deviations of the chosen model at each case where the case's whole part is left out: with B the
/// part, those of the inverse of (K^-1)_BB.
Eigen::VectorXd FigureModel::deviations_without_parts() const {
  const int parts = std::min(most_parts, cases());
  Eigen::VectorXd deviations(cases());
  for (int part = 0; part < parts; ++part) {
    std::vector<int> left;
    for (int i = part; i < cases(); i += parts) left.push_back(i);
    const std::vector<Eigen::Index> columns = columns_of(left);
    const Eigen::MatrixXd own = inverse_(columns, columns);
    deviations(left) = own.inverse().diagonal().head(std::ssize(left)).cwiseSqrt();
  }
  return deviations;
}

Eigen::MatrixXd FigureModel::figures_from(const Eigen::MatrixXd& displacements) const {
  Eigen::MatrixXd values(std::ssize(figures_), displacements.cols());
  for (Eigen::Index j = 0; j < values.cols(); ++j)
    for (std::size_t f = 0; f < figures_.size(); ++f)
      values(static_cast<Eigen::Index>(f), j) =
          figures_[f].of(displacements.col(j).segment(rows_[f], rows_[f + 1] - rows_[f]));
  return values;
}

/// Of the figures of each column from those of another; how far fields are apart has no sign.
Eigen::MatrixXd FigureModel::differences(const Eigen::MatrixXd& columns,
                                         const Eigen::MatrixXd& others) const {
  Eigen::MatrixXd values(std::ssize(figures_), columns.cols());
  for (Eigen::Index j = 0; j < values.cols(); ++j)
    for (std::size_t f = 0; f < figures_.size(); ++f) {
      const auto one = columns.col(j).segment(rows_[f], rows_[f + 1] - rows_[f]),
                 other = others.col(others.cols() == 1 ? 0 : j).segment(rows_[f], rows_[f + 1] - rows_[f]);
      values(static_cast<Eigen::Index>(f), j) =
          figures_[f].is_field() ? Figure::distance(one, other) : figures_[f].of(one) - figures_[f].of(other);
    }
  return values;
}

std::vector<RecordedParameters> FigureModel::parameters_at(const Eigen::MatrixXd& points) const {
  std::vector<RecordedParameters> list(static_cast<std::size_t>(points.cols()), cases_.parameters.front());
  for (Eigen::Index j = 0; j < points.cols(); ++j)
    for (Eigen::Index k = 0; k < points.rows(); ++k)
      list[static_cast<std::size_t>(j)].set(varying_[static_cast<std::size_t>(k)].name, points(k, j));
  return list;
}

void FigureModel::for_pieces(Eigen::Index points,
                             const std::function<void(Eigen::Index first, Eigen::Index count)>& work) {
  parallel_for(static_cast<int>((points + points_at_once - 1) / points_at_once), [&](int piece) {
    const Eigen::Index first = piece * points_at_once;
    work(first, std::min(points_at_once, points - first));
  });
}

FigureModel::Answers FigureModel::at(const Eigen::MatrixXd& points) const {
  Answers answers{Eigen::MatrixXd(std::ssize(figures_), points.cols()),
                  Eigen::MatrixXd(std::ssize(figures_), points.cols())};
  for_pieces(points.cols(), [&](Eigen::Index first, Eigen::Index count) {
    const auto found = model_->at(parameters_at(points.middleCols(first, count)));
    const Eigen::MatrixXd displacements =
        cases_.displacements * found.weights + cases_.derivatives * found.derivatives;
    Eigen::MatrixXd errors(std::ssize(figures_), count);
    estimate_errors(found, displacements, errors);
    answers.values.middleCols(first, count) = figures_from(displacements);
    answers.errors.middleCols(first, count) = errors;
  });
  return answers;
}

FigureModel::Function FigureModel::function_of(const std::vector<Told>& list) const {
  std::vector<Figure> figures;
  std::vector<Eigen::Index> rows{0};
  Eigen::MatrixXd data;
  for (const auto& [figure, own] : list) {
    figures.push_back(figures_[static_cast<std::size_t>(figure)]);
    const Eigen::MatrixXd part = figures.back().linear_part(own);
    data.conservativeResize(rows.back() + part.rows(), data_.cols());
    data.bottomRows(part.rows()) = part;
    rows.push_back(data.rows());
  }
  return [this, coefficients = model_->coefficients_of(data), figures, rows](const Eigen::MatrixXd& points) {
    Eigen::MatrixXd values(std::ssize(figures), points.cols());
    for_pieces(points.cols(), [&](Eigen::Index first, Eigen::Index count) {
      const Eigen::MatrixXd sums = model_->sums(coefficients, parameters_at(points.middleCols(first, count)));
      for (std::size_t k = 0; k < figures.size(); ++k)
        for (Eigen::Index j = 0; j < count; ++j)
          values(static_cast<Eigen::Index>(k), first + j) =
              figures[k].of_linear_part(sums.col(j).segment(rows[k], rows[k + 1] - rows[k]));
    });
    return values;
  };
}

FigureModel::Function FigureModel::values() const {
  std::vector<Told> list;
  list.reserve(figures_.size());
  for (int f = 0; f < std::ssize(figures_); ++f) list.push_back({f, data_of_figure(f)});
  return function_of(list);
}

/// Without case i the prediction is d - r_i w_i, where w_i is its weight and r_i its residual; with
/// derivatives the sum of that over all its data.
void FigureModel::estimate_errors(const DisplacementModel::Predictions& found,
                                  const Eigen::MatrixXd& displacements,
                                  Eigen::Ref<Eigen::MatrixXd> errors) const {
  Eigen::MatrixXd apart;  // of two models, where the cases cannot tell which is right
  if (found.others.size() > 0) apart = differences(cases_.displacements * found.others, displacements);
  for (Eigen::Index j = 0; j < errors.cols(); ++j) {
    Eigen::MatrixXd without = -(residuals_.leftCols(cases()) * found.weights.col(j).asDiagonal());
    for (std::size_t d = 0; d < cases_.by.size(); ++d) {
      const auto k = static_cast<Eigen::Index>(d);
      without.col(cases_.derivative_of[d]) -= found.derivatives(k, j) * residuals_.col(cases() + k);
    }
    without.colwise() += displacements.col(j);
    const Eigen::MatrixXd changes = differences(without, displacements.col(j));
    for (Eigen::Index f = 0; f < errors.rows(); ++f) {
      std::vector<double> above, below;  // where the figure may be, from the prediction on
      for (Eigen::Index i = 0; i < cases(); ++i) {
        const double change = changes(f, i), residual = ratios_(f, i) * found.deviations[j];
        above.push_back(residual + change), below.push_back(residual - change);
      }
      errors(f, j) = std::max(kept(std::move(above), share), kept(std::move(below), share));
      if (apart.size() > 0) errors(f, j) = std::hypot(errors(f, j), apart(f, j));
    }
  }
}

/// A weight that is held at zero changes the others by the column of the inverse that undoes it, and what
/// these make of the displacements is as if the cases left out had that contribution less.
FigureModel::Function FigureModel::without_parts(int parts, int figure) const {
  const Eigen::MatrixXd data = data_of_figure(figure);
  std::vector<Told> list;
  for (int k = 0; k < parts; ++k) {
    std::vector<int> left;
    for (int i = k; i < cases(); i += parts) left.push_back(i);
    const std::vector<Eigen::Index> columns = columns_of(left);
    const Eigen::MatrixXd own = inverse_(columns, columns);
    list.push_back({figure, data});
    list.back().data(Eigen::all, columns) -=
        own.transpose().ldlt().solve((data * inverse_(Eigen::all, columns)).transpose()).transpose();
  }
  return function_of(list);
}

double FigureModel::fit_error(int figure) const {
  std::vector<double> known;
  for (const double error : cases_.fit_errors.row(figure))
    if (std::isfinite(error)) known.push_back(error);
  return known.empty() ? std::nan("") : median(known);
}

Eigen::MatrixXd FigureModel::covariance(const Eigen::MatrixXd& points) const {
  return model_->covariance(parameters_at(points));
}

double FigureModel::outside(const Eigen::VectorXd& point) const {
  return model_->outside(parameters_at(point).front());
}

}  // namespace cleft
