// One step of the cut changes the mesh: a vertex of the path is made there, walls are sewn in below it, and
// slivers next to it are mended. Inside explorer/incision only.
#pragma once

#include "explorer/incision/incision_state.h"

namespace cleft {

/// Makes the step's vertex; returns it.
int realise(IncisionState& cut, const PathStep& step);

/// The chain goes on to vertex `next` at s: walls open behind it.
void grow(IncisionState& cut, int next, double s);

/// Mends slivers among the triangles changed since then. Throws InputError where one without area is left.
void mend(IncisionState& cut, const CutMesh::Checkpoint& since);

/// All of a step. Throws InputError where the mesh would become another surface.
void take(IncisionState& cut, const PathStep& step);

/// Makes triangles smaller where the step would end in one much larger than itself. Returns whether it has,
/// so that the step has to be found again.
bool made_room(IncisionState& cut, const PathStep& step);

}  // namespace cleft
