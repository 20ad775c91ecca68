// A volume mesh, cut together with its surface and moved by the same fields.
#pragma once

#include <string>
#include <vector>

#include "explorer/incision/incision.h"
#include "explorer/io/volume_mesh.h"
#include "explorer/wound/replayed_wounds.h"

namespace cleft {

/// Splits the cells that the blade has passed, moves all points as they are at t mm of all paths, and writes
/// `out`. `surface` is the volume's, uncut. Without `wounds` nothing moves. Returns the number of added
/// cells.
int write_cut_volume(VolumeMesh& volume, const SurfaceMesh& surface, const std::vector<const Incision*>& cuts,
                     const ReplayedWounds* wounds, double scale, double t, const std::string& out);

}  // namespace cleft
