// Keeps the lips of a fit from overlapping further than those of the data.
#pragma once

#include "encoder/field/field.h"
#include "encoder/series.h"

namespace cleft {

/// The field with the control points at v = 0 moved apart, as little as possible in the sum of squares, so
/// that at every released pair of nodes and every frame the lips' opening across the cut is at least that of
/// the data or, where the data are open, at least 0; plus `margin` (mm) for the later rounding of control
/// points. Pairs for which a lip would then differ from the data by more than `most` (mm) are not changed.
Field with_lips_apart(const Field& field, const Series& series, double margin, double most);

}  // namespace cleft
