#include "explorer/scalpel/cutting_moment.h"

namespace cleft {

std::shared_ptr<const CuttingMoment> moment_of(ScalpelCutting& cutting, const CuttingMoment* before) {
  auto moment = std::make_shared<CuttingMoment>();
  moment->cuts = cutting.figures().cuts;
  moment->cut_length = cutting.cut_length();
  if (before && before->cuts == moment->cuts)
    moment->surface = before->surface;
  else
    moment->surface = std::make_shared<const WoundSurface>(
        wound_surface_of(cutting.mesh(), cutting.original_points(), cutting.colors()));
  moment->points.resize(moment->surface->points.size());
  for (std::size_t v = 0; v < moment->points.size(); ++v)
    moment->points[v] = cutting.position(static_cast<int>(v));
  return moment;
}

}  // namespace cleft
