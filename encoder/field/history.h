// The displacement at one point over t, as cubic pieces: which a replay evaluates in each frame.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "base/vec3.h"

namespace cleft {

/// Cubic Bezier pieces, one after the other in t. Reusing a History for many points allocates no memory once
/// it is large enough.
struct History {
  std::vector<double> breaks;  ///< n + 1, increasing: from the field's first t to its last, or that asked for
  std::vector<std::array<Vec3, 4>> controls;  ///< n: of the piece between two breaks
  double error = 0;  ///< largest distance from the field found at points between, mm; 0 if it is exact

  std::vector<double> scratch;  ///< memory for the contraction
};

/// The part of a Bezier piece between its parameters s0 and s1, by blossoms.
std::array<Vec3, 4> part_of_piece(const std::array<Vec3, 4>& piece, double s0, double s1);

/// The sum of the histories, each times its factor, over the same first and last t: its breaks are those of
/// all of them.
void combine(std::span<const History> histories, std::span<const double> factors, History& out);

/// Value at t, clamped to the breaks. Pieces need not meet: at a break the later piece counts.
Vec3 evaluate(const History& history, double t);

}  // namespace cleft
