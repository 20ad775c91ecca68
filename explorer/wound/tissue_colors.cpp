#include "explorer/wound/tissue_colors.h"

#include <algorithm>

namespace cleft {

PointColor tissue_color(double depth_fraction) {
  const double at = std::clamp(depth_fraction, 0., 1.);
  std::size_t k = 1;
  while (k + 1 < tissue_stops.size() && tissue_stops[k].depth_fraction < at) ++k;
  const TissueStop &above = tissue_stops[k - 1], &below = tissue_stops[k];
  const double part = (at - above.depth_fraction) / (below.depth_fraction - above.depth_fraction);
  const auto between = [part](double a, double b) { return static_cast<float>(a + part * (b - a)); };
  return {between(above.red, below.red), between(above.green, below.green), between(above.blue, below.blue)};
}

std::vector<PointColor> with_tissue(std::vector<PointColor> skin, const std::vector<double>& depth_fraction) {
  for (std::size_t v = 0; v < skin.size(); ++v)
    if (depth_fraction[v] > 0) skin[v] = tissue_color(depth_fraction[v]);
  return skin;
}

}  // namespace cleft
