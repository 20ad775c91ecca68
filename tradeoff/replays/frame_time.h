// The time of a frame of a replay.
#pragma once

#include "encoder/field/field.h"

namespace cleft {

/// Seconds for the positions of 10,000 vertices around the cut: the median over all frames. Vertices that
/// never move by more than `detail`, mm, stay at rest.
double frame_seconds(const Field& field, double detail = 0);

}  // namespace cleft
