// What no single parameter's range can state.
#pragma once

#include <string>

#include "params/parameters/parameters.h"

namespace cleft {

/// The cut lies within the patch, the mesh has a node to open, ... Throws InputError that names the values.
void check_consistency(const Parameters& parameters, const std::string& where);

/// Nodes of the mesh, about, before it is made. Throws InputError as check_consistency() does.
double estimated_nodes(const Parameters& parameters);

}  // namespace cleft
