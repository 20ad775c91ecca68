// The error report of a field.
#pragma once

#include "encoder/field/field.h"
#include "encoder/field/node_residual.h"
#include "encoder/series.h"

namespace cleft {

/// Errors of a field against the series it stands for, at every node and frame; node_error with the residual
/// where there is one. Keeps what the fit reported of itself.
FitReport measure(const Field& field, const Series& series, const NodeResidual* residual = nullptr);

/// What the field leaves of the displacements, in steps such that no node is off by more than `bound`, mm.
NodeResidual residual_of(const Field& field, const Series& series, double bound);

}  // namespace cleft
