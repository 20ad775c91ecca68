// The steps of a cut up to the position of the blade. Inside explorer/incision only.
#pragma once

#include "explorer/incision/incision_state.h"

namespace cleft {

/// Cuts to arc length s, clamped to the path, as Incision::advance_to.
void cut_on_to(IncisionState& cut, double s);

/// Cuts the first segment and undoes it. The search for the start has evicted all other data from the caches;
/// this loads the data of the blade's first steps again.
void rehearse(IncisionState& cut);

}  // namespace cleft
