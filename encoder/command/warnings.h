// What cleft encode warns of.
#pragma once

#include <string>
#include <vector>

#include "encoder/between_nodes.h"
#include "encoder/encode.h"

namespace cleft {

/// Where the spline of the displacement or of a further quantity, which is what is drawn, or the opening of
/// the break in it, is off by more than twice the tolerance, at the nodes or between them: by how much,
/// where, why, and what helps. `between`: of add_between_nodes().
std::vector<std::string> warnings_of(const Field& field, const std::vector<BetweenNodes>& between,
                                     const Series& series, const EncodeOptions& options);

}  // namespace cleft
