// Parameters by which a series can be differentiated.
#pragma once

#include <string>
#include <vector>

#include "params/parameters/parameters.h"

namespace cleft {

/// Throws InputError where one of the names is none by which the solver differentiates: a number of a
/// material or of the foundation (any group but patch, cut and mesh), without contact of the lips. `where`:
/// the option or the file's entry that holds them.
void check_sensitivities(const std::vector<std::string>& names, const Parameters& parameters,
                         const std::string& where);

}  // namespace cleft
