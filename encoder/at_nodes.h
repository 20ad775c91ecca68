// A series against splines at all of its nodes.
#pragma once

#include <vector>

#include "encoder/field/encoded.h"
#include "encoder/node_work.h"
#include "encoder/series.h"

namespace cleft {

/// Errors of a spline at all nodes, of each frame.
std::vector<NodeErrors> node_errors(const Series& series, const NodeSpline& spline);

/// The step of whole multiples that put no node off by more than a share of `bound` (norms_of): by half a
/// step each way in each component.
double step_within(double bound, int components, double share);

/// What a spline leaves at all nodes from a frame on, so that no node is off by more than `bound`. Sets
/// `largest` to the norm of what spline and code together leave.
CodedResidual code_left(const Series& series, const NodeSpline& spline, int first_frame, double bound,
                        double& largest);

}  // namespace cleft
