// The error report of a field.
#pragma once

#include "encoder/field/field.h"
#include "encoder/field/node_residual.h"
#include "encoder/series.h"

namespace cleft {

/// Errors of a field's spline against the series it stands for, at every node and frame. Keeps what the fit
/// reported of itself.
FitReport measure(const Field& field, const Series& series);

/// What the field leaves of the displacements, in steps such that no node is off by more than `bound`, mm.
/// The field's node_error becomes that of both together.
NodeResidual residual_of(Field& field, const Series& series, double bound);

}  // namespace cleft
