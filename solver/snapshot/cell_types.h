// VTK's types of cells.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace cleft {

/// The edges of a linear cell, by its corners; none of other types.
const std::vector<std::array<std::size_t, 2>>& edges_of_type(int type);

/// Whether cells of the type have less than three dimensions.
bool is_flat_type(int type);

}  // namespace cleft
