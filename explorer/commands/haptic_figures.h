// What `cleft haptic` reports and writes of its loop and of the mesh that it has cut.
#pragma once

#include "base/command/command.h"
#include "explorer/scalpel/scalpel_cutting.h"
#include "haptic/bare_timer.h"
#include "haptic/loop.h"

namespace cleft {

/// Of the motion, the forces and the cuts.
Json figures_of(const HapticLoop& loop, const ScalpelCutting& cutting);

/// Adds the times that ticks and steps took by the wall's clock, and what was late.
void add_times(Json& figures, HapticLoop& loop, const BareTimer& bare, const ScalpelCutting& cutting);

/// The mesh as it was left, in its own units; with the arrays displacement, depth and region of `cleft cut`.
void write_cut_mesh(const std::string& file, ScalpelCutting& cutting, double scale);

}  // namespace cleft
