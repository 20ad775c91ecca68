// Stresses, temperatures and the like beside the displacement, on the same knots.
#pragma once

#include <optional>

#include "encoder/field/field.h"
#include "encoder/field/node_residual.h"
#include "encoder/series.h"

namespace cleft {

/// The series of three components of a quantity, the first of them `component`, as data of a fit: columns
/// beyond its last are 0; nodes alone count. largest_displacement is the quantity's largest value.
Series series_of(const Series& series, const SeriesQuantity& quantity, int component);

struct FittedQuantity {
  Quantity quantity;
  std::optional<NodeResidual> residual;  ///< where the spline alone does not keep the tolerance
};

/// Fits a quantity of the series over the bases of the field. `tolerance` bounds its largest error at any
/// node and frame, over its largest value; without one nothing does, and there is no residual. Control points
/// are multiples of a step that costs a small part of it, or of the error that there is.
FittedQuantity fit_quantity(const Series& series, const SeriesQuantity& data, const Field& field,
                            std::optional<double> tolerance);

}  // namespace cleft
