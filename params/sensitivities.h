// Parameters by which a series can be differentiated.
#pragma once

#include <string>
#include <vector>

#include "params/parameters/parameters.h"

namespace cleft {

/// Throws InputError unless the solver can differentiate by each of the names: numbers of a material or of
/// the foundation (any group but patch, cut and mesh), without contact of the lips. `where`: the option or
/// the file's entry that holds them.
void check_sensitivities(const std::vector<std::string>& names, const Parameters& parameters,
                         const std::string& where);

/// Whether it can by this one.
bool has_sensitivity(const std::string& name, const Parameters& parameters);

}  // namespace cleft
