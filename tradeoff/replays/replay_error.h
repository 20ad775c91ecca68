// Errors of replayed cuts against the solver's own simulations of the same cuts.
#pragma once

#include "encoder/field/field.h"
#include "explorer/incision/incision.h"
#include "explorer/wound/prestress_fields.h"
#include "solver/snapshot/snapshot.h"

namespace cleft {

/// The path of the blade through one of the snapshot's parallel cuts: an arc where cut.radius is above 0,
/// tilted by cut.tilt.
ScalpelPath path_of(const Snapshot& snapshot, int cut = 0);

/// Largest values over all frames; lengths in mm.
struct ReplayError {
  double gape = 0;           ///< largest distance between the lips in the simulation
  double gape_error = 0;     ///< of the vector from lip to lip
  double skin_error = 0;     ///< of the displacement of any vertex of the skin from the closed frame
  double frame_seconds = 0;  ///< for all vertices' positions: the least of many, the median of frames
  std::size_t vertices = 0;
};

/// Cuts the skin of the simulation along the simulated cut, moves it by the field, and compares each frame.
/// Vertices that never move by more than `detail`, mm, stay at rest.
ReplayError replay_error(const SnapshotReader& truth, const Field& field, double detail = 0);

/// Two parallel cuts, the field replayed along both, while the second is made.
ReplayError parallel_error(const SnapshotReader& truth, const Field& field);

/// A cut and a branch that leaves its middle (a T), while the branch is made. The fields follow the tension.
ReplayError branch_error(const SnapshotReader& truth, const PrestressFields& fields);

/// One cut with fields superposed for the prestress of the simulation, rotated into the path's frame.
ReplayError replay_error(const SnapshotReader& truth, const PrestressFields& fields);

}  // namespace cleft
