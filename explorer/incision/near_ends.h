// Ends of cuts that all but meet another cut.
#pragma once

#include <vector>

#include "explorer/incision/scalpel_path.h"

namespace cleft {

/// mm: a bridge of skin as narrow as that is a path's rounding, and nothing that is left by intention.
constexpr double narrowest_bridge = 0.05;

struct JoinedEnd {
  int cut, other;  ///< of the paths
  bool start;      ///< of the cut; else its end
  double gap;      ///< that there was between them
};

/// Paths of one mesh, whose ends have been moved on, the way that they go, over other paths that they end
/// just before, or on: a T, in place of a bridge of skin that is next to nothing.
struct JoinedPaths {
  std::vector<ScalpelPath> paths;
  std::vector<JoinedEnd> ends;  ///< that were not on them
};

/// `near`: the widest bridge, in the paths' units, as the gap in the result.
JoinedPaths with_near_ends_joined(std::vector<ScalpelPath> paths, double near);

}  // namespace cleft
