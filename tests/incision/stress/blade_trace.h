// How far the blade's path is over the uncut surface: an answer to compare lips with.
#pragma once

#include <optional>

#include "explorer/incision/scalpel_path.h"
#include "tests/incision/stress/surface_walker.h"

namespace cleft::stress {

/// The length over the surface of where the blade's line pierces it, from arc length `from`, where that is at
/// `start`, to `to`, where it is at `end` (either of them perhaps on the boundary, which no line pierces).
/// None where it jumps: at folds that the blade does not pass upright.
std::optional<double> blade_trace(const Ground& ground, const ScalpelPath& path, const Vec3& start,
                                  double from, const Vec3& end, double to);

}  // namespace cleft::stress
