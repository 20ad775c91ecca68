// Stresses, temperatures and the like beside the displacement, on the same knots.
#pragma once

#include "encoder/field/field.h"
#include "encoder/series.h"

namespace cleft {

/// The series of three components of a quantity, the first of them `component`, as data of a fit: columns
/// beyond its last are 0; nodes alone count. largest_displacement is the quantity's largest value.
Series series_of(const Series& series, const SeriesQuantity& quantity, int component);

/// Fits the series' quantities over the bases of the field, and measures them. Control points are rounded to
/// what costs at most a twentieth of `tolerance`, relative to the quantity's largest value.
std::vector<Quantity> fit_quantities(const Series& series, const Field& field, double tolerance);

}  // namespace cleft
