// The ladders of knots: nested, in normalised parameters, so that every case can pick its rung alone and
// cases can still be brought to a common one by inserting knots.
#pragma once

#include <array>
#include <vector>

#include "encoder/field/bspline.h"
#include "encoder/field/parametrization.h"

namespace cleft {

/// Numbers of spans. A parametrisation that follows the tip has them before the start of the cut, along it
/// and ahead of its tip; on each side of v = 0; beside the cut's depth and below its bottom; in time. A fixed
/// one has no before, after and below.
struct Rung {
  int before = 1, along = 1, after = 1, across = 1, above = 1, below = 1, time = 1;

  friend bool operator==(const Rung&, const Rung&) = default;
};

inline constexpr int most_time_spans = 32;

/// Bases over along, across, height and time. A rung with as many or more spans in every number has all knots
/// of the lesser one. Where the tip is followed, knots crowd toward it and the start, the cut's plane and its
/// bottom; where the cut begins or ends at the patch's edge or goes through its bottom, there are none
/// beyond. Without a cut (length 0) `across` has no break. `frames` (more than 1) bounds degree and spans in
/// time.
std::array<BSplineBasis, 4> bases_of(const Rung& rung, const Parametrization& parametrization, int frames);

/// Rungs of growing size, each within the next, with one span in time: how many a series needs there is seen
/// from the series. Following the tip, what paid early in trials on a few cuts comes first.
std::vector<Rung> ladder_of(const Parametrization& parametrization);

}  // namespace cleft
