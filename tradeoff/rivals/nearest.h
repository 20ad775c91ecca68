// The nearest kept node for each node.
#pragma once

#include <vector>

#include "encoder/samples.h"

namespace cleft {

/// For every sample the nearest of `kept` (indices of samples) that is not on the other side of v = 0.
std::vector<int> nearest_kept(const std::vector<Sample>& samples, const std::vector<int>& kept);

}  // namespace cleft
