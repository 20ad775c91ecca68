// The identity of a case's stiffness matrix.
#pragma once

#include <string>

#include "params/parameters/parameters.h"

namespace cleft {

/// The parameters on which K depends, as text: cases with equal texts have equal K and share its
/// factorisation.
std::string stiffness_key(Parameters parameters);

}  // namespace cleft
