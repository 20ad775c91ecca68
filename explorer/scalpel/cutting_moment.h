// A snapshot of the mesh under the scalpel, for the drawing thread.
#pragma once

#include <memory>
#include <vector>

#include "explorer/scalpel/scalpel_cutting.h"
#include "explorer/wound/wound_surface.h"

namespace cleft {

/// The state of the cutting, in mesh units; consecutive states without a cut between them share the surface.
struct CuttingMoment {
  std::shared_ptr<const WoundSurface> surface;
  std::vector<Vec3> points;
  double cut_length = 0;  ///< mm
  int cuts = 0;           ///< CuttingFigures::cuts as of the surface
};
/// `before`: the previous state, or null.
std::shared_ptr<const CuttingMoment> moment_of(ScalpelCutting& cutting, const CuttingMoment* before);

}  // namespace cleft
