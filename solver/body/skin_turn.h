// By which angle the skin of a body turns: beyond a little of it, small strains need the stiffness of
// tension.
#pragma once

#include <vector>

#include "params/parameters/parameters.h"
#include "solver/body/body.h"

namespace cleft {

/// The angle by which a triangle of skin turns most that is farther from all cuts than one and a half times
/// the first one's depth. Nearer to them lips turn far on any body, and the farther the finer the mesh is: by
/// up to 0.68 to 0.95 radians on a plate, where finite strains are 4 to 7 % off.
struct Turn {
  double angle = 0;  ///< radians
  Vec3 at;           ///< mm
};
Turn most_turned_skin(const Body& body, const std::vector<Vec3>& displacement);

/// Radians: such skin turns in small strains by 0.13 on a plate, by 0.14 to 0.21 beside a blade that leans by
/// 45 degrees, by 0.24 on a cylinder of 30 mm, 0.46 on one of 12 and 0.69 on one of 7, whatever the elements.
/// Wounds are then too wide by 8, 4 to 6, 13, 25 and 39 %.
constexpr double much_turn = 0.35, most_turn = 0.6;
/// The skin.turning_stiffness that is advised where skin turns so far: from 0 at much_turn to 1 at most_turn,
/// so that no answer jumps.
double turning_share(double angle);

/// Whether skin could resist turning by its tension, and does not.
bool lacks_stiffness_of_tension(const Parameters& parameters);

}  // namespace cleft
