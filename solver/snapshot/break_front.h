// The front of a break in a mesh, by its cells alone.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace cleft {

/// For each node whether it is at the front of a break: whole, and in cells with divided nodes on both sides
/// of it. No coordinates are compared. `offsets` (cells + 1), `connectivity`: the cells' nodes. `sides`: -1
/// left and 1 right of divided nodes, else 0. `pairs`: left and right nodes at one place, which are whole
/// together where their sides are 0.
std::vector<bool> nodes_at_front(const std::vector<std::int64_t>& offsets,
                                 const std::vector<std::int64_t>& connectivity,
                                 const std::vector<std::array<std::int32_t, 2>>& pairs,
                                 const std::vector<std::int8_t>& sides);

}  // namespace cleft
