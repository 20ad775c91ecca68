// How long a frame of a replay takes.
#pragma once

#include "encoder/field/field.h"

namespace cleft {

/// Seconds for the positions of 10,000 vertices about the cut: the median over all its frames. Those that
/// never move by more than `detail` mm are left alone.
double frame_seconds(const Field& field, double detail = 0);

}  // namespace cleft
