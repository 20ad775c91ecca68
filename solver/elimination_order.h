// In which order the unknowns of a patch are eliminated.
#pragma once

#include <vector>

#include "solver/patch_mesh.h"
#include "solver/patch_system.h"

namespace cleft {

/// Position of every unknown in the order: nested dissection of the grid under the closed mesh, then
/// `kept`, the unknowns of the pairs' right nodes, as they stand. MUMPS by itself falls back to minimum
/// degree where it is asked for a Schur complement.
std::vector<int> elimination_order(const PatchMesh& mesh, const PatchSystem& system,
                                   const std::vector<int>& kept);

}  // namespace cleft
