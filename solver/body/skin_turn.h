// By which angle the skin of a body turns: beyond a little of it, small strains need the stiffness of
// tension.
#pragma once

#include <vector>

#include "params/parameters/parameters.h"
#include "solver/body/body.h"

namespace cleft {

/// The angle of the triangle of skin that turns most.
struct Turn {
  double angle = 0;  ///< radians
  Vec3 at;           ///< mm
};
Turn most_turned_skin(const Body& body, const std::vector<Vec3>& displacement);

/// Radians. More than all bodies of tests/truth; beyond it wounds open up to three times too wide in small
/// strains.
constexpr double much_turn = 0.9;
/// The skin.turning_stiffness that is advised where skin turns so far: 0 up to much_turn, so that no answer
/// jumps, and 1 from a tenth of a radian beyond it.
double turning_share(double angle);

/// Whether skin could resist turning by its tension, and does not.
bool lacks_stiffness_of_tension(const Parameters& parameters);

}  // namespace cleft
