// Bone below a patch or a body.
#pragma once

#include "params/parameters/parameters.h"

namespace cleft {

/// N/mm^3, in all directions: so firm that bone moves by a thousandth of what the tissue above it does.
inline double springs_of_bone(const Parameters& p) { return 1000 * p.tissue.young_modulus / p.patch.height; }

}  // namespace cleft
