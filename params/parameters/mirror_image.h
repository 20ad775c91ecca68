// The mirror image of a case in the plane v = 0, of the upright straight cut.
#pragma once

#include <string>

#include "params/parameters/parameters.h"

namespace cleft {

/// Whether a number has the other sign in the mirror image: bends, tilts, the skin's twist, shear.
bool changes_sign_in_mirror(const std::string& name);

/// Displacements are those of the case at (u, -v, w), with the other sign across.
Parameters mirror_image(Parameters parameters);

/// Whether the mirror image of a case tells what the case itself does not: of a symmetric shape of which
/// tensions superpose it tells nothing.
bool mirror_image_tells(const Parameters& parameters);

}  // namespace cleft
