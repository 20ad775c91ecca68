// What the skin of a simulated body lies on, for the force and the dent of a blade that presses it.
#pragma once

#include <vector>

namespace cleft {

/// A layer of one tissue.
struct TissueLayerBelow {
  double young_modulus, poisson_ratio;  ///< MPa
  double height;                        ///< mm
};

/// The tissue below one place of the skin.
struct TissueBelow {
  std::vector<TissueLayerBelow> layers;  ///< from the skin down; at least one
  double foundation;                     ///< N/mm^3, of the springs below, in all directions
};

}  // namespace cleft
