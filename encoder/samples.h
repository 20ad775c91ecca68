// The nodes of a snapshot as places in the field's parameter space.
#pragma once

#include <vector>

#include "encoder/field/field.h"
#include "solver/snapshot/snapshot.h"

namespace cleft {

/// Where data are given: a position, and the side for those on v = 0. Side::both asks both sides for the same
/// value.
struct Sample {
  Vec3 uvw;
  Side side;
};

/// One sample a node, in node order. On v = 0 a node's side comes from /cut/pairs; single nodes there are
/// uncut.
std::vector<Sample> samples_of(const Snapshot& snapshot);

}  // namespace cleft
