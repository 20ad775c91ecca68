// The rungs of a ladder that the data can determine.
#pragma once

#include <vector>

#include "encoder/ladder.h"
#include "encoder/series.h"

namespace cleft {

/// Nodes for each control point in space, where it follows the front: with fewer, matrices are up to a
/// hundred times worse conditioned. And where edges hold the spline between the nodes, too.
inline constexpr double enough_nodes = 3.4, nodes_held_between = 1.5;
/// And where edges hold it firmly, on close knots.
inline constexpr double nodes_held_firmly = 0.5;

/// The ladder, limited to the spans that the positions of the nodes in the last frame determine on each axis
/// (Schoenberg and Whitney), and further limited if nodes are few for the control points in space (with a
/// parametrisation that moves, or if all nodes are in a plane). Contains at least the first rung, with the
/// spans in height that the levels of nodes determine.
std::vector<Rung> supported(const std::vector<Rung>& ladder, const Series& series,
                            const Parametrization& parametrization, double nodes_at_front = enough_nodes);

/// Whether values at these places, in ascending order, determine a spline: one place for each function, in
/// order, where it does not vanish (Schoenberg and Whitney).
bool determined(const BSplineBasis& basis, const std::vector<double>& places);

/// The places of the series' samples on the axes along, across and height at the last time, ascending, each
/// once.
std::array<std::vector<double>, 3> places_on_axes(const Series& series,
                                                  const Parametrization& parametrization);

}  // namespace cleft
