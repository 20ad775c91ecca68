// Ends of cuts that all but meet another cut.
#pragma once

#include <optional>
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

/// How far an end of a path has to go straight on to be `beyond` over the other path, if that is no farther
/// ahead than `near`; none where it is not there, or the end runs beside it. In the paths' units.
std::optional<double> way_over(const ScalpelPath& path, bool start, const ScalpelPath& other, double near,
                               double beyond);

/// `near`: the widest bridge, in the paths' units, as the gap in the result.
JoinedPaths with_near_ends_joined(std::vector<ScalpelPath> paths, double near);

}  // namespace cleft
