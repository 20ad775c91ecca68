// Where the path begins on the mesh. Nothing is changed here. Inside explorer/incision only.
#pragma once

#include <vector>

#include "explorer/incision/incision_state.h"

namespace cleft {

/// Where the path begins: on the skin at C(0), or where it enters over the boundary. Throws InputError if it
/// does not meet the mesh.
PathStep find_start(const IncisionState& cut);

/// The skin's triangles at the start.
std::vector<int> triangles_at(const IncisionState& cut, const PathStep& start);

}  // namespace cleft
