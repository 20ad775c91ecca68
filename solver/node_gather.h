// Displacements by node, in the order of files, from the distributed unknowns of the solver.
#pragma once

#include <vector>

#include "base/vec3.h"
#include "solver/patch_system.h"

namespace cleft {

/// One column of unknowns (owned() entries) as displacements of the mesh's nodes, mm: on rank 0, which writes
/// the files; empty elsewhere. Collective.
std::vector<Vec3> gather_nodes(const PatchSystem& system, const PatchMesh& mesh, const double* column);

}  // namespace cleft
