// A mesh and its break in (u, v, w): a snapshot without its displacements.
#pragma once

#include <optional>
#include <vector>

#include "encoder/field/break_map.h"
#include "encoder/import/placement.h"
#include "encoder/import/release.h"
#include "solver/snapshot/snapshot.h"

namespace cleft {

struct Placed {
  Snapshot snapshot;            ///< of the mesh, its pairs and their release
  std::vector<Vec3> canonical;  ///< coordinates of the break, where they are not the places of the nodes
  std::optional<BreakMap> map;  ///< from one to the other
};

/// `mesh`: that of the series, or a part of it, whose nodes the pairs are of. `given`: has the map, where it
/// is known. Throws InputError if the times of frames are the same when counted from the first.
Placed snapshot_of(const ImportedSeries& series, const SourceMesh& mesh, const Break& found,
                   const Placement& placement, bool is_flat, const Placed* given = nullptr,
                   const BeyondArm& beyond = {});

}  // namespace cleft
