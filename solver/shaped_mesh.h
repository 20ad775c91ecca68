// Gives the mesh of a box the shape of its patch.
#pragma once

#include <vector>

#include "solver/patch_mesh.h"
#include "solver/patch_mesh_grid.h"

namespace cleft {

/// Moves the nodes of a mesh with a single cut to their places (solver/patch_shape.h), turns the pairs'
/// normals, and sets tension, coordinates and frames. `grid_node`: by node, the number of the grid's node at
/// its place. A cut that is tilted only keeps its mesh and gets coordinates. Throws InputError where an
/// element would be flat or turned over.
void give_shape(PatchMesh& mesh, const PatchGrid& grid, const std::vector<int>& grid_node,
                const Parameters& parameters);

}  // namespace cleft
