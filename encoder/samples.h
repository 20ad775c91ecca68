// The nodes of a snapshot as places in the field's parameter space.
#pragma once

#include <vector>

#include "encoder/spatial_fit.h"
#include "solver/snapshot/snapshot.h"

namespace cleft {

/// One sample a node, in node order. On v = 0 a node's side comes from /cut/pairs; single nodes there are
/// uncut.
std::vector<Sample> samples_of(const Snapshot& snapshot);

}  // namespace cleft
