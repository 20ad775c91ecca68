// Derivatives of the displacement by parameters, on the knots and by the least squares of the displacement.
#pragma once

#include <vector>

#include "encoder/field/field.h"
#include "encoder/series.h"
#include "encoder/series_fit.h"

namespace cleft {

/// Fits the derivatives of the series with the factorisation of `fit`, that of the displacement: a fit is
/// linear in the data, so the derivative of the fitted displacement is the same fit of the derivative.
/// Control points are rounded to a quantum that costs a small part of their error.
std::vector<ParameterDerivative> fit_derivatives(const Series& series, const SeriesFit& fit);

}  // namespace cleft
