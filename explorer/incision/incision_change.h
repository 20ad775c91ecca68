// One step of the cut changes the mesh: a vertex of the path is made there, walls are sewn in below it, and
// slivers next to it are repaired. Inside explorer/incision only.
#pragma once

#include "explorer/incision/incision_state.h"

namespace cleft {

/// Makes the step's vertex; returns it.
int realise(IncisionState& cut, const PathStep& step);

/// Extends the chain to vertex `next` at s: walls open behind it.
void grow(IncisionState& cut, int next, double s);

/// Repairs slivers among the triangles changed since then. Throws InputError if one without area remains.
void mend(IncisionState& cut, const CutMesh::Checkpoint& since);

/// All of a step. Throws InputError if the topology of the mesh would change.
void take(IncisionState& cut, const PathStep& step);

/// Refines triangles if the step would end in one much larger than itself. Returns whether it did, so that
/// the step must be searched again.
bool made_room(IncisionState& cut, const PathStep& step);

}  // namespace cleft
