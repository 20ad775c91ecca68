// What the splines of a study's cases leave at the nodes, between these cases.
#pragma once

#include <string>

#include "encoder/field/encoded.h"
#include "encoder/interpolate/study_interpolator.h"

namespace cleft {

/// StudyInterpolator::at() with a residual: where all cases of the folder `study` have one mesh and the same
/// frames, as those of one body have, what their splines leave at its nodes adds up as their splines do. The
/// report's node_error is the estimate with it, spline_error that without. There is no residual where no
/// case has one or cases have derivatives, whose splines leave what no file tells; nor of a study.dffd.
Encoded between_with_nodes(const StudyInterpolator& interpolator, const std::string& study,
                           const CaseParameters& values);

}  // namespace cleft
