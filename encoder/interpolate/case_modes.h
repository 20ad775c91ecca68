// The fields between the cases of a study as sums of a few modes, where many of them are wanted.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "encoder/interpolate/study_interpolator.h"

namespace cleft {

class CaseModes {
 public:
  /// The leading left singular vectors of the cases' control points, each case over its largest displacement:
  /// as many as leave of each case at most `error` of its root mean square. The study must outlive this.
  CaseModes(const StudyInterpolator& study, double error);

  int count() const { return static_cast<int>(modes_.size()); }
  /// StudyInterpolator::at(), also of what could not be meshed, within the error of the modes, ten to a
  /// hundred times as fast. The largest displacement of its report is that of the lips when all is cut.
  Field at(const CaseParameters& values) const;

 private:
  const StudyInterpolator& study_;
  std::vector<std::vector<float>> modes_;
  Eigen::MatrixXd shares_;  // modes x (cases and derivatives): weights of modes in a case
};

}  // namespace cleft
