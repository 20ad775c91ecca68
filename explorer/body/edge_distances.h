// Distances along the edges of triangles.
#pragma once

#include <array>
#include <vector>

#include "base/vec3.h"

namespace cleft {

/// Of each point from the nearest of some; infinite where no edges lead there.
std::vector<double> edge_distances(const std::vector<Vec3>& points,
                                   const std::vector<std::array<int, 3>>& triangles,
                                   const std::vector<int>& from);

}  // namespace cleft
