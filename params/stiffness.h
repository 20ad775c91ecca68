// The identity of a case's stiffness matrix.
#pragma once

#include <string>

#include "params/parameters/parameters.h"

namespace cleft {

/// The parameters on which K depends, as text: cases with equal texts have equal K and share its
/// factorisation. (In the finite model K is the tangent at the reference state, and all but the cut counts.)
std::string stiffness_key(Parameters parameters);

}  // namespace cleft
