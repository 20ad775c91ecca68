// The colours of tissue below the skin, for pictures and files.
#pragma once

#include <array>
#include <vector>

#include "explorer/incision/surface_mesh.h"

namespace cleft {

struct TissueStop {
  double depth_fraction;  ///< 0 at the skin, 1 at the bottom of the cut
  double red, green, blue;
};

/// Dermis, fat, muscle.
inline constexpr std::array<TissueStop, 6> tissue_stops{{{0, 0.86, 0.52, 0.46},
                                                         {0.12, 0.80, 0.40, 0.36},
                                                         {0.20, 0.93, 0.74, 0.46},
                                                         {0.50, 0.90, 0.66, 0.36},
                                                         {0.64, 0.66, 0.17, 0.13},
                                                         {1, 0.34, 0.04, 0.05}}};

/// Linear between the stops.
PointColor tissue_color(double depth_fraction);

/// Colours of the skin, one for each vertex, with those of tissue at all below the skin: for files, in which
/// skin and walls share the vertices of the lips. Empty where there are none.
std::vector<PointColor> with_tissue(std::vector<PointColor> skin, const std::vector<double>& depth_fraction);

}  // namespace cleft
