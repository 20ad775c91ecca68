// Nodes that stand at the same place.
#pragma once

#include <cstdint>
#include <vector>

#include "encoder/import/series.h"

namespace cleft {

using Groups = std::vector<std::vector<std::int32_t>>;

/// Groups of two or more points closer than `tolerance` to another of the group; each ascending, by their
/// first.
Groups coincident_groups(const std::vector<Vec3>& points, double tolerance);

/// Every cell with nodes of its own, or nearly so: most nodes have company.
bool is_unwelded(const SourceMesh& mesh, const Groups& groups);

/// Makes one of those coincident nodes whose values agree in every field and frame, up to rounding. Returns
/// the number of nodes that went.
std::size_t weld(Series& series, const Groups& groups);

}  // namespace cleft
