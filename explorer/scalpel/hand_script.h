// What a simulated hand does with a scalpel along a path: down, through the skin, along, and out.
#pragma once

#include <vector>

#include "explorer/incision/scalpel_path.h"
#include "explorer/incision/surface_mesh.h"
#include "haptic/devices/hand.h"

namespace cleft {

/// mm; `height` above the path's place s. `scale`: mm per unit of the path, here and below.
ScalpelPose pose_over(const ScalpelPath& path, double scale, double s, double height);

/// Down onto the path's start, through the skin, along the path at `speed` mm/s at its depth, and up again.
std::vector<HandTarget> hand_along(const ScalpelPath& path, double scale, double speed,
                                   const HandParameters& hand, const ForceParameters& force);

/// 10 mm over the highest place above the mesh's middle.
ScalpelPose pose_above(const SurfaceMesh& mesh, double scale);

}  // namespace cleft
