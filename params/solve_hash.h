// The identity of a case for the solver.
#pragma once

#include <string>

#include "params/parameters/parameters.h"

namespace cleft {

/// A hash (16 hexadecimal digits) of all resolved parameters, and of the snapshot format's version.
/// `body`: the hash of the body that is solved in place of a patch.
std::string solve_hash(const Parameters& parameters, const std::string& body = {});

}  // namespace cleft
