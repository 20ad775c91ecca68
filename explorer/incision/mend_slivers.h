// Better triangles of the skin where a cut has left slivers.
#pragma once

#include <array>
#include <vector>

#include "explorer/incision/cut_mesh.h"

namespace cleft {

/// Mends the skin's triangles among `triangles`, and those made on the way, whose radius ratio is below
/// `target`: by flipping an edge where that moves the surface by no more than `bend`, else by splitting the
/// longest edge. Stops after a number of changes in proportion to the triangles given. Returns whether the
/// surface has moved at all. The edge `kept` is left whole.
using KeptEdge = std::array<int, 2>;
bool mend_slivers(CutMesh& mesh, const std::vector<int>& triangles, double target, double bend = 0,
                  const KeptEdge& kept = {-1, -1});
/// The same for the few that are still below `target` then: by the splits that, with what can be mended after
/// them, leave the best triangles. Each is tried, so this costs more.
bool mend_needles(CutMesh& mesh, const std::vector<int>& triangles, double target, double bend = 0,
                  const KeptEdge& kept = {-1, -1});

}  // namespace cleft
