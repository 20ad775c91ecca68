// The surface of a mesh of any cells.
#pragma once

#include <array>
#include <vector>

#include "solver/snapshot/snapshot.h"

namespace cleft {

/// Triangles of the faces that one cell alone has, outward; of cells in a plane these themselves. Of curved
/// cells the corners are taken. Both sides of a break with doubled nodes are among them.
std::vector<std::array<int, 3>> skin_of(const Snapshot& mesh);

}  // namespace cleft
