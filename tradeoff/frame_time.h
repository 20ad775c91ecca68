// How long a frame of a replay takes.
#pragma once

#include "encoder/field/field.h"

namespace cleft {

/// Seconds for the positions of 10,000 vertices about the cut: the median over all its frames.
double frame_seconds(const Field& field);

}  // namespace cleft
