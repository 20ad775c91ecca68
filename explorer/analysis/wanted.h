// What is wanted of a study: figures or parameters that are to be least or greatest, under a condition.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "explorer/analysis/figure_model.h"
#include "explorer/analysis/optimum.h"
#include "explorer/study/expression.h"

namespace cleft {

struct Aim {
  std::string name;       ///< a figure or a parameter
  bool greatest = false;  ///< is to be, not least
};

class Wanted {
 public:
  /// The condition, which may be empty, has the names gape, displacement, figures with numbers in brackets
  /// and the numeric parameters. Throws InputError with what is expected. `certain`: it shall hold wherever
  /// its figures are within their errors.
  Wanted(std::vector<Aim> aims, const std::string& condition, bool certain);

  const std::vector<Aim>& aims() const { return aims_; }
  /// Those of the aims and of the condition, of which a model is needed.
  const std::vector<Figure>& figures() const { return figures_; }
  /// The number of the figure that an aim is; none of a parameter.
  std::optional<int> figure_of(const Aim& aim) const;

  /// Of a model of figures(): the aims, a row each, with the sign that makes the least one the best; and how
  /// far the condition is from holding. Throws InputError if the study does not know a parameter.
  struct Judged {
    Eigen::MatrixXd aims;
    Eigen::VectorXd excess;
  };
  Judged judge(const FigureModel& model, const Eigen::MatrixXd& points, const FigureModel::Answers& figures,
               bool with_errors) const;
  Judged judge_cases(const FigureModel& model) const;  ///< by their own figures, without errors
  /// Whether points are to be judged with the errors of figures.
  bool needs_errors() const { return certain_ && !uncertain_.empty(); }

 private:
  int figure(const std::string& text);
  /// The values of names_ at a point.
  std::vector<double> values_at(const FigureModel& model, const Eigen::VectorXd& point,
                                const Eigen::VectorXd& figures) const;
  double excess_with_errors(std::vector<double> values, const Eigen::VectorXd& errors) const;

  std::vector<Aim> aims_;
  std::vector<Figure> figures_;
  std::vector<std::string> names_;  // of the condition and of the aims
  std::vector<int> figure_of_name_;
  std::optional<Expression> condition_;
  std::vector<std::size_t> uncertain_;  // names of figures in the condition
  bool certain_;
};

/// Parameters between the cases.
struct BestParameters {
  Eigen::VectorXd point;    ///< of the model's varying parameters
  Eigen::VectorXd figures;  ///< of Wanted::figures()
  Eigen::VectorXd errors;   ///< 95 % of new cases are within
  bool holds = false;       ///< the condition; else this is the nearest to it
  bool certain = false;     ///< it holds wherever its figures are within their errors
  int evaluations = 0;
};
/// By the first aim, within the ranges of the study's cases.
BestParameters best_parameters(const FigureModel& model, const Wanted& wanted);

/// The cases that fulfil the condition and that no other one of these surpasses in all aims (Pareto), by the
/// first aim, the best one first.
std::vector<int> best_cases(const FigureModel& model, const Wanted& wanted);

}  // namespace cleft
