// Where a cut begins, ends and has its bottom, by what is whole next to the pairs that part.
#pragma once

#include <limits>
#include <vector>

#include "encoder/field/parametrization.h"
#include "solver/snapshot/snapshot.h"

namespace cleft {

struct BreakEnds {
  CanonicalCut cut;
  std::vector<double> tip;  ///< F: u of the tip, mm
  /// How far in u the field must reach at least: beyond the body where a growing cut divides it to its end,
  /// since what is at the tip, or ahead of it, is whole.
  double reach = -std::numeric_limits<double>::infinity();
};

/// Of a snapshot over (u, v, w) within `domain`. A simulation's cut reaches to where it is recorded. Where
/// only pairs are known, the cut begins, ends and has its bottom at whole nodes that share cells with both
/// sides of pairs that part (`parted`, one for each pair). Where there are none, it is open there: it
/// reaches a face of the body, an edge, a notch or a hole, and goes on to the end of the domain, so that no
/// comparison of places decides whether a mouth is closed; or to where the body beyond a hole is whole: to
/// nodes with cells on both sides. Without cells all whole nodes of v = 0 count.
BreakEnds break_ends(const Snapshot& s, const std::vector<bool>& parted,
                     const std::array<Interval, 3>& domain);

}  // namespace cleft
