// Fields for parameters between those of a study's cases.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "encoder/interpolate/common_cases.h"
#include "encoder/interpolate/features.h"
#include "encoder/interpolate/geometry_model.h"
#include "encoder/interpolate/kernel_regression.h"

namespace cleft {

/// Reads a study once; at() then takes milliseconds and changes nothing (it may be called by many threads).
///
/// Control points over the scale of their load (Features) and over a power law of the features, fitted to
/// their norm, are interpolated by the method that best predicts each case from the others. The error
/// expected of a field is the method's own deviation there, times what residuals of cases left out have been
/// of theirs.
class StudyInterpolator {
 public:
  /// A parameter that differs among the cases, and its range there.
  struct Range {
    std::string name;
    double least, greatest;
  };

  /// Of a study folder or a study.dffd; throws InputError as read_members() and CommonCases do.
  explicit StudyInterpolator(const std::string& study);
  explicit StudyInterpolator(CommonCases cases);

  const std::vector<Range>& varying() const { return varying_; }
  const CommonCases& cases() const { return cases_; }
  const Features& features() const { return model_->features; }
  const KernelRegression& regression() const { return model_->regression; }
  /// Largest residual of each case left out, over its largest displacement.
  const Eigen::VectorXd& left_out_errors() const { return model_->errors; }

  /// The field of these values; those of all other parameters are the cases'. Its report holds the estimated
  /// error as node_error and spline_error, and the largest displacement; all else there is not a number.
  /// Throws InputError where a name is unknown (the nearest is suggested), a varying one is missing, another
  /// one is changed, or a value is out of its physical range. Outside the cases it answers too: see
  /// Field::interpolation.
  Field at(const CaseParameters& values) const;

 private:
  struct Model {
    Features features;
    Eigen::MatrixXd places;     // n x d: the cases' features
    Eigen::VectorXd exponents;  // of the power law in them
    Eigen::VectorXd scales;     // n, mm: what the cases' control points are divided by
    KernelRegression regression;
    Eigen::VectorXd errors;
    double error_of_deviation;  // mm / mm: residual, at its largest point, for a deviation of 1
    double score;               // what models are compared by
  };
  static Model model_of(const CommonCases& cases, const Eigen::MatrixXd& samples, Loading loading);
  CaseParameters complete(const CaseParameters& values) const;
  double outside(const CaseParameters& parameters) const;

  CommonCases cases_;
  std::vector<CaseParameters> parameters_;  // of the cases
  std::vector<Range> varying_;
  GeometryModel geometry_;
  std::optional<Model> model_;
  double fit_error_;  // of the cases' own fields
};

}  // namespace cleft
