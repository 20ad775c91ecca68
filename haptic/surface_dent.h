// The shape of skin that sinks under a blade before puncture, so that pictures agree with the force.
#pragma once

#include <vector>

#include "haptic/surface_stiffness.h"

namespace cleft {

constexpr double dent_reach = 30;  ///< mm

/// The depression relative to that under the blade, for uniform pressure on the disc of surface_stiffness.h;
/// it decreases to zero at dent_reach.
class SurfaceDent {
 public:
  SurfaceDent();                                 ///< of a half space
  explicit SurfaceDent(const SkinLayer& layer);  ///< of skin and tissue on their foundation
  /// For the parameters of the field's case.
  explicit SurfaceDent(const Field& field);

  double at(double distance) const;  ///< mm; 1 at 0

 private:
  std::vector<double> table_;  // at even distances
};

}  // namespace cleft
