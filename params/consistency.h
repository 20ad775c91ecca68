// Conditions between several parameters.
#pragma once

#include <string>

#include "params/parameters/parameters.h"

namespace cleft {

/// Checks that the cut is within the patch, the mesh has a node to open, ... Throws InputError that names the
/// values.
void check_consistency(const Parameters& parameters, const std::string& where);

/// Throws InputError that names the prestress if it would compress the skin in some direction.
void check_tension(const Parameters& parameters, const std::string& where);

/// The approximate number of nodes of the mesh, before it is made. Throws InputError as check_consistency()
/// does.
double estimated_nodes(const Parameters& parameters);

}  // namespace cleft
