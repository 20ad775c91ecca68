// The surface of a break that is no plane, and the front of a round one, from its pairs.
#pragma once

#include <optional>
#include <vector>

#include "encoder/field/break_map.h"

namespace cleft {

/// The places of a break over (u, v, w), v across its best plane.
struct BreakPlaces {
  std::vector<Vec3> pairs, front;  ///< of pairs that part; of whole nodes at its front
  std::vector<Vec3> beyond;        ///< of nodes of faces that continue its lips
  Interval u, w;                   ///< of the body
  double rounding = 0;             ///< mm: places that are closer are the same
};

/// From the least to the largest of a component.
Interval range_of(const std::vector<Vec3>& places, int axis);

/// The surface through all places: the spline of least curvature that has them, which goes on straight beyond
/// them. Constant along w where the places are. `farthest`: how far it is from one of them.
BreakMap surface_through(const BreakPlaces& places, double& farthest);

/// The centre and the shape of a front that closes the break on all sides, on all sides but the upper one, or
/// on two that meet (a crack in a corner), and is no box: at least a third of its places are well within the
/// box around it.
std::optional<BreakMap::Round> round_front(const BreakPlaces& places);

}  // namespace cleft
