// How long a frame of a replay takes.
#pragma once

#include <vector>

#include "encoder/field/field.h"

namespace cleft {

/// Of one or more; the upper one of an even number.
double median(std::vector<double> values);

/// Seconds for the positions of 10,000 vertices about the cut: the median over all its frames.
double frame_seconds(const Field& field);

}  // namespace cleft
