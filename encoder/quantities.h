// Further quantities such as stresses or temperatures, on the knots of the displacement or on their own.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "encoder/field/field.h"
#include "encoder/field/node_residual.h"
#include "encoder/series.h"

namespace cleft {

/// The series of three components of a quantity, the first of them `component`, as data of a fit: columns
/// beyond its last are 0; only nodes are used. largest_displacement is the quantity's scale.
Series series_of(const Series& series, const SeriesQuantity& quantity, int component);

/// What its errors are relative to, in its own unit: 1 where the quantity is 0.
inline double scale_of(const SeriesQuantity& quantity) { return quantity.scale > 0 ? quantity.scale : 1; }

struct FittedQuantity {
  Quantity quantity;
  std::optional<CodedResidual> residual;  ///< if the spline alone does not satisfy the tolerance
};

/// Fits quantity `number` of the series over the bases of the field; where it is off by more than twice the
/// limit, and even knots of its own halve that, over these. `limit` bounds the norm of its error at
/// any node and frame, in its own unit; without one there is no bound and no residual. Control points are
/// multiples of a quantum that costs a small part of the limit, or of the error.
FittedQuantity fit_quantity(const Series& series, int number, const Field& field, std::optional<double> limit,
                            const std::function<void(const std::string&)>& progress);

}  // namespace cleft
