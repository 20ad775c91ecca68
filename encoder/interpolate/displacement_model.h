// Displacements of a study's cases as a function of their parameters.
#pragma once

#include <Eigen/Core>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "encoder/interpolate/features.h"
#include "encoder/interpolate/kernel_regression.h"

namespace cleft {

/// Places at which the displacements of cases are compared.
struct CaseSamples {
  /// Of cases: all, or where there are many some that stand for all (representative_cases).
  std::vector<int> cases;
  /// A column for each, x, y, z of displacements, mm.
  Eigen::MatrixXd displacements;
  /// The same of derivatives by parameters, mm per unit: of a case, by a name.
  std::vector<int> derivative_of;
  std::vector<std::string> parameter;
  Eigen::MatrixXd derivatives;
  bool fitted_alike = false;  ///< CommonCases::fitted_alike()
};

/// At most `most` cases that are farthest from one another; in order.
std::vector<int> representative_cases(const std::vector<RecordedParameters>& cases, int most);

/// How the prestress of a study may enter, the likeliest first: it superposes where the model is linear in
/// it.
std::vector<Loading> loadings_of(const RecordedParameters& of_a_case);

/// The regression is for displacements divided by the scale of their load (Features) and by a power law of
/// the features that is fitted to their norms. The method is the one with the least leave-one-out error at
/// the worst points, with the derivatives by parameters or without.
class DisplacementModel {
 public:
  /// Derivatives are given for all cases or for none.
  DisplacementModel(const std::vector<RecordedParameters>& cases, const CaseSamples& samples,
                    Loading loading);

  struct Prediction {
    Eigen::VectorXd weights;      ///< of the cases, for everything that is linear in their displacements
    Eigen::VectorXd derivatives;  ///< of the derivatives, in units of their parameter
    double error;                 ///< mm: estimate of the largest error at any place
  };
  Prediction at(const RecordedParameters& parameters) const;
  nlohmann::ordered_json data() const;  ///< see Features

  /// Many predictions at once, a column for each.
  struct Predictions {
    Eigen::MatrixXd weights, derivatives;  ///< as in Prediction
    Eigen::VectorXd deviations;            ///< mm: to be calibrated by those of cases left out
    /// Weights of the cases by another model, where the cases tell too little of which is right; else empty.
    Eigen::MatrixXd others;
  };
  Predictions at(const std::vector<RecordedParameters>& list) const;
  /// What is linear in the displacements, at many places: sums() = data * weights without errors, for the
  /// cost of a row of coefficients in place of that of a square matrix. data: quantities x (cases, and
  /// their derivatives behind them).
  Eigen::MatrixXd coefficients_of(const Eigen::MatrixXd& data) const;
  Eigen::MatrixXd sums(const Eigen::MatrixXd& coefficients,
                       const std::vector<RecordedParameters>& list) const;
  /// Covariances of the predictions' errors, in the square of the unit of the deviations; columns are changed
  /// by a case at a place as by Kriging.
  Eigen::MatrixXd covariance(const std::vector<RecordedParameters>& list) const;
  /// The predictions of each of all cases from those of all others.
  Predictions left_out() const;
  /// The inverse of the covariance of the cases' displacements, and of the derivatives behind them; 0 of
  /// those that the model does not use.
  Eigen::MatrixXd inverse() const;

  /// Distance of parameters from the cases: that of the features from their convex hull, where the spread of
  /// each is 1, and that of the load's direction from the span of the cases' directions.
  double outside(const RecordedParameters& parameters) const;

  const Features& features() const { return features_; }
  const KernelRegression& regression() const { return *regression_; }
  bool uses_derivatives() const { return regression_->rows() > places_.rows(); }
  /// Leave-one-out errors: the largest residual of each case over its largest displacement; and the root of
  /// their mean square.
  const Eigen::VectorXd& left_out_errors() const { return errors_; }
  double left_out_error() const { return left_out_error_; }

 private:
  /// A case's loads and features alone, without the power law, by a polynomial of the first degree.
  struct Plain {
    std::vector<int> of;  ///< cases
    Eigen::VectorXd scales;
    KernelRegression regression;
    Eigen::MatrixXd samples;                 ///< a few
    std::optional<KernelRegression> chosen;  ///< of the same cases
    Eigen::MatrixXd data;                    ///< what that is made from, of the same few
  };
  /// A derivative that features or load move along, as a row of the regression.
  struct Way {
    Eigen::Index derivative, of;
    Features::Slope slope;
    double log_scale, size;  ///< of scales_; of the slope
  };
  /// Where predictions are wanted.
  struct Points {
    Eigen::MatrixXd places, loads;
    Eigen::VectorXd plain_scales, scales;  // without the power law, and with it
  };
  Points points_of(const std::vector<RecordedParameters>& list) const;
  Eigen::MatrixXd to_rows(const Eigen::MatrixXd& data) const;
  Eigen::MatrixXd from_rows(const Eigen::MatrixXd& weights) const;
  void add_ways(const std::vector<RecordedParameters>& cases, const CaseSamples& samples);
  TrainingCases training(const std::vector<int>& cases, bool with_ways) const;
  void choose(const std::vector<int>& cases, const Eigen::MatrixXd& normal);
  bool sees_curvature() const;
  bool ways_see_all_features() const;

  Features features_;
  Eigen::MatrixXd places_, loads_;  // n x d, n x k
  Eigen::VectorXd exponents_;       // of the power law
  Eigen::VectorXd scales_;          // n, mm: what displacements are divided by
  std::vector<Way> ways_;
  Eigen::Index derivatives_ = 0;
  bool fitted_alike_;
  std::optional<KernelRegression> regression_;
  Eigen::VectorXd errors_;
  double left_out_error_ = 0;
  double error_of_deviation_ = 0;  // residual, at its worst point, for a deviation of 1
  std::optional<Plain> plain_;     // where the cases cannot tell curvature
};

/// The model of the first loading, unless one of a later loading predicts the cases left out much better.
DisplacementModel best_model(const std::vector<RecordedParameters>& cases, const CaseSamples& samples,
                             const std::vector<Loading>& loadings);

}  // namespace cleft
