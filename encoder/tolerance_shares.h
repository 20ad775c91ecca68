// How the tolerance is divided: the same for displacements and for other quantities.
#pragma once

#include <algorithm>

namespace cleft {

/// Of the tolerance: for the fit of all frames, and for rounding to the nearest quantum in the worst case.
inline constexpr double share_of_fit = 0.97, share_of_steps = 0.12;
/// On close knots, whose fit leaves more room: seldom do many coefficients err together.
inline constexpr double share_of_close_steps = 0.5;
/// What steps are for: the bound of the spline's error, but at most ten tolerances where a residual is coded,
/// which larger steps would cost more bytes than they save. `limit`: the tolerance; 0: there is none.
inline double bound_of_steps(double bound, double limit) {
  return limit > 0 ? std::min(bound, 10 * limit) : bound;
}
/// Tolerances, of a spline that is worth more bytes, and what denser knots must make of the errors of
/// quantities.
inline constexpr double far_off = 2, worth_of_denser = 0.5;
/// Quanta that a coefficient may be moved to need fewer bytes.
inline constexpr double farthest_move = 0.625;
/// Least bound for quanta, over the largest value.
inline constexpr double finest_bound = 1e-9;

}  // namespace cleft
