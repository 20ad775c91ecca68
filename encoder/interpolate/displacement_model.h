// Displacements of a study's cases as a function of their parameters.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "encoder/interpolate/features.h"
#include "encoder/interpolate/kernel_regression.h"

namespace cleft {

/// What is regressed on are displacements over the scale of their load (Features) and over a power law of the
/// features that is fitted to their norms. Of all methods that one is taken that predicts cases left out
/// best, in their worst points.
class DisplacementModel {
 public:
  /// `samples`: a column for each case, x, y, z of displacements at places where they are to be compared, mm.
  DisplacementModel(const std::vector<CaseParameters>& cases, const Eigen::MatrixXd& samples,
                    Loading loading);

  struct Prediction {
    Eigen::VectorXd weights;  ///< of the cases, for whatever is linear in their displacements
    double error;             ///< mm: expected of the largest at any place
  };
  Prediction at(const CaseParameters& parameters) const;

  /// Distance of parameters from the cases': of the features from their convex hull, where the spread of each
  /// is 1, and of the load's direction from all that cases' sums have.
  double outside(const CaseParameters& parameters) const;

  const Features& features() const { return features_; }
  const KernelRegression& regression() const { return *regression_; }
  /// Largest residual of each case left out, over its largest displacement; and the root of their mean
  /// square.
  const Eigen::VectorXd& left_out_errors() const { return errors_; }
  double left_out_error() const { return left_out_error_; }

 private:
  /// A case's loads and features alone, without the power law, by a polynomial of the first degree.
  struct Plain {
    Eigen::VectorXd scales;
    KernelRegression regression;
    Eigen::MatrixXd samples;  ///< a few
  };
  void choose(const TrainingCases& training, const Eigen::MatrixXd& normal);
  bool sees_curvature() const;

  Features features_;
  Eigen::MatrixXd places_, loads_;  // n x d, n x k
  Eigen::VectorXd exponents_;       // of the power law
  Eigen::VectorXd scales_;          // n, mm: what displacements are divided by
  std::optional<KernelRegression> regression_;
  Eigen::VectorXd errors_;
  double left_out_error_ = 0;
  double error_of_deviation_ = 0;  // residual, at its worst point, for a deviation of 1
  std::optional<Plain> plain_;     // where the cases cannot tell curvature
};

}  // namespace cleft
