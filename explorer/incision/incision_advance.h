// How far to cut: the steps of the path up to where the blade is. Inside explorer/incision only.
#pragma once

#include "explorer/incision/incision_state.h"

namespace cleft {

/// Cuts on to arc length s, clamped to the path, as Incision::advance_to.
void cut_on_to(IncisionState& cut, double s);

/// Cuts the first segment and takes it back. The search for the start has driven everything else out of the
/// caches: so the blade finds there what its first steps read and write, instead of waiting for it.
void rehearse(IncisionState& cut);

}  // namespace cleft
