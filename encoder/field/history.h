// The displacement at one point over t, as cubic pieces: what a replay evaluates every frame.
#pragma once

#include <array>
#include <vector>

#include "base/vec3.h"

namespace cleft {

/// Cubic Bezier pieces, one after the other in t. Reusing one History for many points allocates nothing once
/// it has grown.
struct History {
  std::vector<double> breaks;  ///< n + 1, increasing: the first and last t of the field included
  std::vector<std::array<Vec3, 4>> controls;  ///< n: of the piece between two breaks
  double error = 0;  ///< largest distance from the field found at points between, mm; 0 where it is exact

  std::vector<double> scratch;  ///< of the contraction
};

/// Value at t, clamped to the breaks. Pieces need not meet: at a break the later piece counts.
Vec3 evaluate(const History& history, double t);

}  // namespace cleft
