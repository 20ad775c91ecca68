// The tissue below the middle of a simulated body's cut.
#pragma once

#include <optional>

#include "encoder/field/tissue_below_cut.h"
#include "solver/snapshot/snapshot.h"

namespace cleft {

/// Below the middle of the (first) cut of a body, or of a patch on bone: the thickness of the tissue there,
/// its layers of different tissue (regions), and springs or bone (springs of 1000 E / patch.height). None
/// where the snapshot is of something else, or lacks the parameters.
std::optional<TissueBelow> tissue_below(const SnapshotReader& reader);

}  // namespace cleft
