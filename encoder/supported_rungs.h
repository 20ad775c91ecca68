// The rungs of a ladder that the data can determine.
#pragma once

#include <vector>

#include "encoder/ladder.h"
#include "encoder/series.h"

namespace cleft {

/// The ladder with no more spans in any number than the places of the nodes at the last frame determine along
/// that axis, and fewer where nodes are few for the control points in space (of a parametrisation that moves
/// past them, or where they all lie in a plane). At least its first rung, with the spans in height that
/// levels of nodes allow.
std::vector<Rung> supported(const std::vector<Rung>& ladder, const Series& series,
                            const Parametrization& parametrization);

}  // namespace cleft
