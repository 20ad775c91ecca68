// The order in which the pairs open, and the position of the tip.
#pragma once

#include "encoder/import/break_plane.h"
#include "solver/snapshot/snapshot.h"

namespace cleft {

/// Of an arm of a break: the pairs of arms that go on where it ends, by their u and the frame in which they
/// open.
struct BeyondArm {
  bool ends_at_others = false;  ///< at its largest u: there it is open as soon as they are
  std::vector<double> u = {};
  std::vector<std::int32_t> first_frame = {};
};

/// Fills the snapshot's pairs (in the order they open, along u and from the top), released, position, and the
/// first cut's start, length and depth, which are the extents of its pairs. Its points and times must be
/// there.
void fill_cut(Snapshot& snapshot, const Break& found, const BeyondArm& beyond = {});

}  // namespace cleft
