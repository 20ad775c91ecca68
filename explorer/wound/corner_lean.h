// How lips lean where two cuts cross: there four pieces of skin have a corner each, which draws back from the
// crossing and rises by what its angle tells, and lips are apart in height by what the corners to either side
// of them are. That is not how they lean further along the cut, and may be the other way.
#pragma once

#include "explorer/wound/mutual_relief.h"

namespace cleft {

/// What lips of a cut do at a crossing.
struct CornerLean {
  double before, after;  ///< how the lips before and behind it lean (Amplitude::leans)
  double share;          ///< 1; less where one of the cuts has not opened beyond the crossing's corners
  double reach_before, reach_after;  ///< mm along the cut to either side, over which this falls by e

  /// How far it counts so many mm from the crossing, before it below 0.
  double at(double from) const;
};

/// Of the lips of `crossing.cut`, as the cuts open it in the membrane, with the blade of the last cut there.
/// Where the other one opens into it, of two corners against a straight lip.
CornerLean lean_at(const Crossing& crossing, const std::vector<const Wound*>& cuts, double blade,
                   const std::vector<Amplitude>& in_membrane);

/// Where cut `later` opens into `cut`, it shears the tissue on its own side of it: which part of the shear at
/// s mm of the path of `cut` is taken from there, and not from the other side. All is where the walls of both
/// are next to each other, none beyond an obtuse corner.
double beside_branch(const Wound& cut, double s, const Wound& later);

}  // namespace cleft
