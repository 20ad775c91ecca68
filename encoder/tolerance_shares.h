// How the tolerance is divided: the same for displacements and for other quantities.
#pragma once

namespace cleft {

/// Of the tolerance: for the fit of all frames, and for rounding to the nearest quantum in the worst case.
inline constexpr double share_of_fit = 0.97, share_of_steps = 0.12;
/// Where a residual is coded, steps are for a spline that is off by at most this many tolerances: larger ones
/// would cost the residual more bytes than they save.
inline constexpr double most_tolerances = 10;
/// Quanta that a coefficient may be moved to need fewer bytes.
inline constexpr double farthest_move = 0.625;
/// Least bound for quanta, over the largest value.
inline constexpr double finest_bound = 1e-9;

}  // namespace cleft
