// The identity of a case for the solver.
#pragma once

#include <string>

#include "params/parameters/parameters.h"

namespace cleft {

/// A hash (16 hexadecimal digits) of all resolved parameters, and of the snapshot format's version.
std::string solve_hash(const Parameters& parameters);

}  // namespace cleft
