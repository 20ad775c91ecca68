// Which cases have the same stiffness matrix.
#pragma once

#include <string>

#include "params/parameters/parameters.h"

namespace cleft {

/// What K depends on, as text: equal texts, equal K, and one factorisation for all such cases.
std::string stiffness_key(Parameters parameters);

}  // namespace cleft
