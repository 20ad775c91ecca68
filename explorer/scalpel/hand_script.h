// The motion of a simulated hand along a path: down, through the skin, along the path, and up.
#pragma once

#include <vector>

#include "explorer/incision/scalpel_path.h"
#include "explorer/incision/surface_mesh.h"
#include "haptic/devices/hand.h"

namespace cleft {

/// mm; `height` above the path's place s. `scale`: mm per unit of the path, here and below.
ScalpelPose pose_over(const ScalpelPath& path, double scale, double s, double height);

/// The motion down to the start of the path, through the skin, along the path at its depth with `speed`,
/// mm/s, and up.
std::vector<HandTarget> hand_along(const ScalpelPath& path, double scale, double speed,
                                   const HandParameters& hand, const ForceParameters& force);

/// A place 10 mm above the highest point over the middle of the mesh.
ScalpelPose pose_above(const SurfaceMesh& mesh, double scale);

}  // namespace cleft
