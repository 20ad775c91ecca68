// Derivatives of the displacement by parameters, on the knots and by the least squares of the displacement.
#pragma once

#include <vector>

#include "encoder/field/field.h"
#include "encoder/series.h"
#include "encoder/series_fit.h"

namespace cleft {

/// Those of the series, from the factorisation of `fit`, the displacement's: a fit is linear in the data, and
/// so the derivative of a fitted displacement is what the same fit makes of the derivative. Control points
/// are rounded to what costs a small part of the error that they have.
std::vector<ParameterDerivative> fit_derivatives(const Series& series, const SeriesFit& fit);

}  // namespace cleft
