// Figures of a study as functions of its parameters, between the cases, with their errors.
//
// The displacements that make a figure are linear in the fields, and are interpolated like these
// (encoder/interpolate); the figure is made of what was interpolated. Its error is found by leaving out
// cases, one after another: by how much the prediction changes without the case, and by how much that case
// differs from what all others predict of it, over the standard deviation of the model there. The sum that
// all but a twentieth of the cases keep is the error (the jackknife+ of Barber, Candes, Ramdas and
// Tibshirani, Predictive inference with the jackknife+, 2021, with residuals over deviations: Lei et al.
// 2018).
#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "encoder/interpolate/common_cases.h"
#include "encoder/interpolate/displacement_model.h"
#include "explorer/analysis/figure.h"
#include "explorer/study/study.h"

namespace cleft {

class FigureModel {
 public:
  /// A parameter that differs among the cases.
  struct Varied {
    std::string name;
    double least, greatest;
  };
  /// What is known of each case.
  struct Cases {
    std::vector<RecordedParameters> parameters;
    Eigen::MatrixXd displacements;  ///< a column for each: of the places of all figures, one after another
    Eigen::MatrixXd fit_errors;     ///< figures x cases, mm: of the fields; NaN where it is not known
    std::vector<int> numbers = {};  ///< in the study; empty: as they stand here
    /// The same displacements' derivatives by parameters, mm per unit: a column for each, of a case. Of all
    /// cases or of none.
    Eigen::MatrixXd derivatives = {};
    std::vector<int> derivative_of = {};
    std::vector<std::string> by = {};
  };
  static constexpr double share = 0.95;  ///< of new cases within the errors

  /// Reads every case once. Throws InputError if fewer than three differ, or if they differ in a choice.
  FigureModel(const PublishedStudy& study, const std::vector<Figure>& figures, const ReportPart& report = {});
  FigureModel(Cases cases, std::vector<Figure> figures);

  const std::vector<Figure>& figures() const { return figures_; }
  const std::vector<Varied>& varying() const { return varying_; }
  int cases() const { return static_cast<int>(cases_.parameters.size()); }
  /// Of a case, in the order of varying(); and its own figures.
  Eigen::VectorXd place_of(int i) const { return places_.col(i); }
  Eigen::VectorXd figures_of(int i) const { return own_.col(i); }
  const RecordedParameters& parameters_of(int i) const {
    return cases_.parameters[static_cast<std::size_t>(i)];
  }
  /// Its number in the study: of cases of equal parameters there is one here.
  int number_of(int i) const {
    return cases_.numbers.empty() ? i : cases_.numbers[static_cast<std::size_t>(i)];
  }
  const std::string& method() const { return model_->regression().covariance().name; }

  /// Figures x points; points: the values of varying(), a column for each.
  struct Answers {
    Eigen::MatrixXd values;
    Eigen::MatrixXd errors;  ///< of the interpolation, of the figure's field; 95 % of new cases are within
  };
  Answers at(const Eigen::MatrixXd& points) const;
  /// Figures of points as above, a column for each.
  using Function = std::function<Eigen::MatrixXd(const Eigen::MatrixXd& points)>;
  /// The values alone: what is solved for here once makes a point cost far less than at() takes. The function
  /// refers to this model.
  Function values() const;
  /// A figure as other data tell it: row k is that of all cases but every `parts`-th from the k-th on
  /// (jackknife).
  Function without_parts(int parts, int figure) const;
  /// What each case's figures would be by all other cases.
  const Eigen::MatrixXd& left_out() const { return left_out_; }
  /// The error of the fields of the cases themselves, mm: the median of the largest of each.
  double fit_error(int figure) const;
  /// What the model does not know of the displacements at points: covariances, in one unit.
  Eigen::MatrixXd covariance(const Eigen::MatrixXd& points) const;
  /// Distance of a point from the study, over its spread; 0 between the cases.
  double outside(const Eigen::VectorXd& point) const;

  /// All parameters of the cases at points.
  std::vector<RecordedParameters> parameters_at(const Eigen::MatrixXd& points) const;

 private:
  /// Calls work(first, count) for pieces of so many points.
  static void for_pieces(Eigen::Index points,
                         const std::function<void(Eigen::Index first, Eigen::Index count)>& work);
  /// Values of figures, one after another, from other data of the cases.
  struct Told {
    int figure;
    Eigen::MatrixXd data;
  };
  Function function_of(const std::vector<Told>& list) const;
  auto data_of_figure(int figure) const {
    const auto f = static_cast<std::size_t>(figure);
    return data_.middleRows(rows_[f], rows_[f + 1] - rows_[f]);
  }
  std::vector<Eigen::Index> columns_of(const std::vector<int>& cases) const;
  Eigen::MatrixXd figures_from(const Eigen::MatrixXd& displacements) const;
  Eigen::MatrixXd differences(const Eigen::MatrixXd& columns, const Eigen::MatrixXd& others) const;
  Eigen::MatrixXd ratios_of(const Eigen::MatrixXd& predicted, const Eigen::VectorXd& deviations) const;
  Eigen::MatrixXd predicted_by_parts() const;
  Eigen::VectorXd deviations_without_parts() const;
  void estimate_errors(const DisplacementModel::Predictions& found, const Eigen::MatrixXd& displacements,
                       Eigen::Ref<Eigen::MatrixXd> errors) const;

  Cases cases_;
  std::vector<Figure> figures_;
  std::vector<Eigen::Index> rows_;  // where the displacements of each figure begin, and the end
  std::vector<Varied> varying_;
  Eigen::MatrixXd places_, own_;
  std::shared_ptr<const DisplacementModel> model_;
  Eigen::MatrixXd data_;       // displacements of the cases, and the derivatives behind them
  Eigen::MatrixXd inverse_;    // of their covariance
  Eigen::MatrixXd residuals_;  // of the data of each case from what all others predict
  Eigen::MatrixXd ratios_;     // figures x cases: residuals over deviations
  Eigen::MatrixXd left_out_;
};

}  // namespace cleft
