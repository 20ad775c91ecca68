// The error report of a field.
#pragma once

#include "encoder/field/field.h"
#include "encoder/field/node_residual.h"
#include "encoder/series.h"

namespace cleft {

/// Errors of a field's spline against its series, at each node and frame. Copies condition and time of the
/// fit from the field's report.
FitReport measure(const Field& field, const Series& series);

/// The residual of the field at the nodes, quantised such that no node differs by more than `bound`, mm. Sets
/// the field's node_error to that of field and residual together.
CodedResidual residual_of(Field& field, const Series& series, double bound);

}  // namespace cleft
