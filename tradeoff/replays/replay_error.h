// How far a replayed cut is from the solver's own simulation of it.
#pragma once

#include "encoder/field/field.h"
#include "explorer/incision/incision.h"
#include "explorer/wound/prestress_fields.h"
#include "solver/snapshot/snapshot.h"

namespace cleft {

/// The blade's way through one of the snapshot's parallel cuts: an arc where cut.radius is above 0, tilted by
/// cut.tilt.
ScalpelPath path_of(const Snapshot& snapshot, int cut = 0);

/// Over all frames; lengths in mm.
struct ReplayError {
  double gape = 0;           ///< largest distance between the lips, of the truth
  double gape_error = 0;     ///< of the vector from lip to lip
  double skin_error = 0;     ///< of the displacement of any vertex of the skin from the closed frame
  double frame_seconds = 0;  ///< for all vertices' positions: the least of many, the median of frames
  std::size_t vertices = 0;
};

/// Cuts the truth's own skin along its own cut, moves it by the field, and compares each frame. Vertices that
/// never move by more than `detail` mm stay where they are.
ReplayError replay_error(const SnapshotReader& truth, const Field& field, double detail = 0);

/// Two parallel cuts, the field replayed along both, while the second is made.
ReplayError parallel_error(const SnapshotReader& truth, const Field& field);

/// A cut and a branch that leaves its middle (a T), while the branch is made. The fields follow the tension.
ReplayError branch_error(const SnapshotReader& truth, const PrestressFields& fields);

/// One cut with the fields superposed for the truth's prestress, turned into the path's own frame.
ReplayError replay_error(const SnapshotReader& truth, const PrestressFields& fields);

}  // namespace cleft
