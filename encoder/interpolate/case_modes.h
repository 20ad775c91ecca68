// The fields between the cases of a study as sums of a few modes, where many of them are wanted.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "encoder/interpolate/study_interpolator.h"

namespace cleft {

class CaseModes {
 public:
  /// The leading left singular vectors of the cases' control points, each case over its largest displacement:
  /// as many as leave of each case at most `error` of its root mean square. The study must outlive this.
  CaseModes(const StudyInterpolator& study, double error) : CaseModes(study, error, error, 0) {}
  /// The same, but from `many` modes on they may leave `enough`.
  CaseModes(const StudyInterpolator& study, double error, double enough, int many);

  int count() const { return static_cast<int>(modes_.size()); }
  /// Control points of a mode on the bases of the cases, as CommonCases::control_points().
  std::span<const float> mode(int k) const { return modes_[k]; }
  /// modes x (cases, then derivatives): of the modes in each of them.
  const Eigen::MatrixXd& shares() const { return shares_; }
  /// StudyInterpolator::at(), also of what could not be meshed, within the error of the modes, ten to a
  /// hundred times as fast. The largest displacement of its report is that of the lips when all is cut.
  Field at(const CaseParameters& values) const;

 private:
  const StudyInterpolator& study_;
  std::vector<std::vector<float>> modes_;
  Eigen::MatrixXd shares_;
};

}  // namespace cleft
