// The elimination order of the unknowns of a patch.
#pragma once

#include <vector>

#include "solver/patch_mesh.h"
#include "solver/patch_system.h"

namespace cleft {

/// Position of each unknown in the order: nested dissection of the closed mesh (a patch's by its grid, a
/// body's by METIS), then `kept`, the unknowns of the pairs' right nodes, in their given order. (MUMPS's own
/// orderings fall back to minimum degree if a Schur complement is requested.)
std::vector<int> elimination_order(const PatchMesh& mesh, const PatchSystem& system,
                                   const std::vector<int>& kept);

}  // namespace cleft
