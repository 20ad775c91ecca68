// The ladder of knots for the parametrisation that follows the tip: nested, in normalised parameters, so that
// every case can pick its rung alone and cases can still be brought to a common one by inserting knots.
#pragma once

#include <array>

#include "encoder/field/bspline.h"
#include "encoder/field/parametrization.h"

namespace cleft {

/// Numbers of spans: before the start of the cut, along it and ahead of its tip; on each side of v = 0;
/// beside the cut's depth and below its bottom; in time.
struct Rung {
  int before = 2, along = 4, after = 2, across = 3, above = 2, below = 1, time = 8;

  friend bool operator==(const Rung&, const Rung&) = default;
};

/// Bases over along, across, height and time. A rung with as many or more spans in every number has all knots
/// of the lesser one. Knots crowd toward the start and the tip, the cut's plane and its bottom, and early
/// times. Where the cut begins or ends at the patch's edge or goes through its bottom, there are none beyond.
/// `frames` (more than 1) bounds degree and spans in time.
std::array<BSplineBasis, 4> bases_of(const Rung& rung, const FieldGeometry& geometry, int frames);

}  // namespace cleft
