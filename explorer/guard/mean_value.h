// Mean value coordinates of a vertex in the ring of its neighbours (Floater 2003).
#pragma once

#include <cstddef>
#include <vector>

#include "base/vec3.h"

namespace cleft {

/// The weights, positive and of sum 1, with which `place` is the mean of the ring around it, once the angles
/// at `place` are scaled such that they fill the plane: in a plane exactly, where the ring goes around once.
std::vector<double> mean_value_weights(const Vec3& place, const std::vector<Vec3>& ring);

/// Solves for the columns behind the first m of a matrix of m rows, [row][column], whose first m columns are
/// diagonally dominant: in place, without pivots. False where they are singular.
bool eliminate(std::vector<double>& matrix, std::size_t m, std::size_t columns);

}  // namespace cleft
