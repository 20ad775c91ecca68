// Fields for parameters between those of a study's cases.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "encoder/interpolate/common_cases.h"
#include "encoder/interpolate/displacement_model.h"
#include "encoder/interpolate/geometry_model.h"

namespace cleft {

/// Reads a study once; at() then takes milliseconds and changes nothing (many threads may call it).
class StudyInterpolator {
 public:
  /// A parameter that differs among the cases, and its range there.
  struct Range {
    std::string name;
    double least, greatest;
  };

  /// Of a study folder or a study.dffd; throws InputError as read_members() and CommonCases do, and what
  /// `told` throws.
  explicit StudyInterpolator(const std::string& study, const ToldPart& told = {});
  explicit StudyInterpolator(CommonCases cases, const ToldPart& told = {});

  const std::vector<Range>& varying() const { return varying_; }
  const CommonCases& cases() const { return cases_; }
  const Features& features() const { return model_->features(); }
  const KernelRegression& regression() const { return model_->regression(); }
  /// Largest residual of each case left out, over its largest displacement.
  const Eigen::VectorXd& left_out_errors() const { return model_->left_out_errors(); }

  /// The field of these values; those of all other parameters are the cases'. Its report holds the estimated
  /// error as node_error and spline_error, and the largest displacement; all else there is not a number.
  /// Throws InputError where a name is unknown (the nearest is suggested), a varying one is missing, another
  /// one is changed, or a value is out of its physical range. Outside the cases it answers too: see
  /// Field::interpolation.
  Field at(const CaseParameters& values) const;

 private:
  CaseParameters complete(const CaseParameters& values) const;
  /// Of the sum of the cases' fields, from their own errors, over its largest displacement.
  double fit_error(const DisplacementModel::Prediction& prediction, double largest) const;
  CaseSamples samples() const;

  CommonCases cases_;
  std::vector<CaseParameters> parameters_;  // of the cases
  std::vector<Range> varying_;
  GeometryModel geometry_;
  std::optional<DisplacementModel> model_;
};

}  // namespace cleft
