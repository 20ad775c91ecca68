// The mesh under the scalpel at one moment, as the thread that draws is given it.
#pragma once

#include <memory>
#include <vector>

#include "explorer/scalpel/scalpel_cutting.h"
#include "explorer/wound/wound_surface.h"

namespace cleft {

/// The cutting at a moment, in mesh units; the surface is shared by those between which nothing was cut.
struct CuttingMoment {
  std::shared_ptr<const WoundSurface> surface;
  std::vector<Vec3> points;
  double cut_length = 0;  ///< mm
  int cuts = 0;           ///< CuttingFigures::cuts as of the surface
};
/// `before`: the moment before, or null.
std::shared_ptr<const CuttingMoment> moment_of(const ScalpelCutting& cutting, const CuttingMoment* before);

}  // namespace cleft
