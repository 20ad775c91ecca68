// Parameters by which a series can be differentiated.
#pragma once

#include <string>
#include <vector>

#include "params/parameters.h"

namespace cleft {

/// Throws InputError where one of the names is none by which the solver differentiates: a number of skin,
/// tissue or foundation, without contact of the lips. `where`: the option or the file's entry that holds
/// them.
void check_sensitivities(const std::vector<std::string>& names, const Parameters& parameters,
                         const std::string& where);

}  // namespace cleft
