// How good a triangle can be between two lips that meet.
#pragma once

#include "explorer/incision/incision.h"

namespace cleft::stress {

/// The largest radius ratio possible in a corner of `triangle`: 1, or where the skin there is a wedge between
/// two lips of `cut`, what the wedge's angle permits, or the least angle between the path's directions
/// along the two straight pieces there, where that is more: a piece runs as the path does somewhere along it.
double best_between_lips(const CutMesh& mesh, int triangle, const Incision& cut);

}  // namespace cleft::stress
