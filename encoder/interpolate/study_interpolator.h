// Fields for parameters between those of a study's cases.
#pragma once

#include <Eigen/Core>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "encoder/interpolate/common_cases.h"
#include "encoder/interpolate/displacement_model.h"
#include "encoder/interpolate/geometry_model.h"
#include "encoder/interpolate/parameter_groups.h"

namespace cleft {

/// Numbers by the names of their parameters, as a user gives them.
using CaseParameters = std::map<std::string, double>;

/// Reads a study once; at() then takes milliseconds and is const (several threads may call it).
class StudyInterpolator {
 public:
  /// A parameter that differs among the cases, and its range there.
  struct Range {
    std::string name;
    double least, greatest;
  };

  /// Of a study folder or a study.dffd; throws InputError as read_members() and CommonCases do, and the
  /// exceptions of `report`.
  explicit StudyInterpolator(const std::string& study, const ReportPart& report = {});
  explicit StudyInterpolator(CommonCases cases, const ReportPart& report = {});

  const std::vector<Range>& varying() const { return varying_; }
  const CommonCases& cases() const { return cases_; }
  /// Of the model of what varies together.
  const Features& features() const { return model_->features(); }
  const KernelRegression& regression() const { return model_->regression(); }
  /// Leave-one-out errors: the largest residual of each case over its largest displacement.
  const Eigen::VectorXd& left_out_errors() const { return model_->left_out_errors(); }

  /// The field for these values; all other parameters are those of the cases. Its report holds the estimated
  /// error as node_error and spline_error, and the largest displacement; all other entries are NaN. Throws
  /// InputError if a name is unknown (the nearest is suggested), a varying parameter is missing, a constant
  /// one is changed, or a value is outside its physical range. Extrapolates outside the cases: see
  /// Field::interpolation.
  Field at(const CaseParameters& values) const;

  /// What at() makes a field of.
  struct Recipe {
    RecordedParameters parameters;
    DisplacementModel::Prediction prediction;  ///< weights of the cases, and the error in mm
    FieldGeometry geometry;
  };
  /// Throws as at() does. `meshable`: a patch of these parameters could be meshed and solved. A shape that
  /// varies along a path need not be one all along a cut.
  Recipe recipe(const CaseParameters& values, bool meshable = true) const;
  /// As at() makes it.
  Field field_of(const Recipe& recipe) const;
  /// Sets parameters, report and interpolation of a field that was made by a recipe.
  void tell(Field& field, const Recipe& recipe, double largest_displacement) const;
  /// Of a field that was made by a recipe, over its largest displacement: of the interpolation, and of the
  /// cases' fits as their reports have it.
  double estimated_error(const Recipe& recipe, double largest_displacement,
                         double FitReport::*of_fit = &FitReport::spline_error) const;
  /// What recipe() and the error in tell() are computed from (docs/formats.md, "Page for browsers").
  nlohmann::ordered_json data() const;

 private:
  RecordedParameters complete(const CaseParameters& given, bool meshable) const;
  CaseParameters with_bottom(CaseParameters values) const;
  double outside(const RecordedParameters& parameters) const;
  /// Of the sum of the cases' fields, from their own errors, over its largest displacement.
  double fit_error(const DisplacementModel::Prediction& prediction, double largest,
                   double FitReport::*of_fit) const;
  /// The parameters with base values of all but those of the group.
  RecordedParameters varied_in(const ParameterGroup& group, RecordedParameters parameters) const;
  /// The prediction of a model of some of the cases, for all of them.
  DisplacementModel::Prediction of_all(const std::vector<int>& cases,
                                       const DisplacementModel::Prediction& of_some) const;

  CommonCases cases_;
  std::vector<RecordedParameters> parameters_;  // of the cases
  std::vector<Range> varying_;
  GeometryModel geometry_;
  ParameterGroups groups_;
  std::optional<DisplacementModel> model_;  // of groups_.together: all cases, if nothing varies alone
  std::vector<DisplacementModel> alone_;    // of each of groups_.alone
};

}  // namespace cleft
