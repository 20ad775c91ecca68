// Nodes at the same place.
#pragma once

#include <cstdint>
#include <vector>

#include "encoder/import/series.h"

namespace cleft {

using Groups = std::vector<std::vector<std::int32_t>>;

/// Groups of two or more points closer than `tolerance` to another of the group; each ascending, by their
/// first.
Groups coincident_groups(const std::vector<Vec3>& points, double tolerance);

/// Whether the mesh is unwelded: (nearly) each cell has its own nodes, so that most nodes have coincident
/// ones.
bool is_unwelded(const SourceMesh& mesh, const Groups& groups);

/// Merges coincident nodes whose values agree in all fields and frames, up to rounding. Returns the number of
/// nodes that were removed.
std::size_t weld(Series& series, const Groups& groups);

}  // namespace cleft
