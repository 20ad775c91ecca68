// How the path goes on: the decisions of the cut. Nothing is changed in the mesh. Inside explorer/incision
// only.
#pragma once

#include "explorer/incision/incision_state.h"

namespace cleft {

/// The next vertex of the path, found once until it is made; at an infinite s where the rest of the path is
/// not worth one. Throws InputError where the path cannot go on.
const PathStep& next_step(IncisionState& cut);

/// The part of a step that leads no farther than to arc length `to`.
PathStep shorter(const IncisionState& cut, const PathStep& step, double to);

/// The triangle that the path, straight on beyond its end, enters from the tip, or from the opposite lip of a
/// wound that it has come to; -1: none.
int triangle_ahead(const IncisionState& cut);

/// Of the skin's vertices at the place of a wound's vertex, one on each lip, that from which the path goes on
/// from s, within `limit`; -1: none.
int lip_ahead(const IncisionState& cut, int wound_vertex, double s, double limit);

/// Whether two wounds cross at a vertex.
bool wounds_cross_at(const IncisionState& cut, int v);

/// How far the straight pieces between the chain's vertices stray from the blade, at most.
double chord_error(const IncisionState& cut);

}  // namespace cleft
