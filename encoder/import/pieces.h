// A body with several breaks: a piece of it for each.
#pragma once

#include <optional>
#include <vector>

#include "encoder/import/break_plane.h"
#include "solver/snapshot/snapshot.h"

namespace cleft {

/// For each break the nodes at which its field counts (encoder/field/field_source.h), and those that share
/// cells with them, in the coordinates of the break. Throws InputError where breaks are so close to each
/// other that a piece would have two.
std::vector<SnapshotPiece> pieces_of(const ImportedSeries& series, std::vector<Break>& breaks,
                                     const std::optional<Vec3>& flat);

}  // namespace cleft
