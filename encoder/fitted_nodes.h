// The nodes of a large snapshot that its fit uses.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "encoder/samples.h"
#include "solver/snapshot/snapshot.h"

namespace cleft {

/// Control points are thousands, so that a million nodes determine them as well as more do. Of samples beyond
/// `most` in number, ascending: all on the plane of the break, all nodes of cells that touch it, and of cells
/// of a grid, which is finer towards the break and its front in depth, two samples each: about `most` in all.
/// Where nodes are in columns along u, the same columns are chosen everywhere. Empty: all are used.
std::vector<std::int32_t> fitted_nodes(const Snapshot& snapshot, const std::vector<Sample>& samples,
                                       std::size_t most);

}  // namespace cleft
