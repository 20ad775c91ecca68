// The lips of the fit pass through each other no further than those of the data.
#pragma once

#include "encoder/field/field.h"
#include "encoder/series.h"

namespace cleft {

/// The field with the control points at v = 0 moved apart, as little as possible in the sum of squares, so
/// that at every released pair of nodes and every frame the lips' opening across the cut is at least that of
/// the data or, where those are open, at least 0; and by `margin` (mm) more, which the rounding of control
/// points may use up. Pairs for which that would put a lip off from the data by more than `most` (mm) are
/// left as they are.
Field with_lips_apart(const Field& field, const Series& series, double margin, double most);

}  // namespace cleft
