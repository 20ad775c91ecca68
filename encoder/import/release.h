// The order in which the pairs open, and the position of the tip.
#pragma once

#include "encoder/import/break_plane.h"
#include "solver/snapshot/snapshot.h"

namespace cleft {

/// Fills the snapshot's pairs (in the order they open, along u and from the top), released, position, and the
/// first cut's start, length and depth, which are the extents of its pairs. Its points and times must be
/// there.
void fill_cut(Snapshot& snapshot, const Break& found);

}  // namespace cleft
