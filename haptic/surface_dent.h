// How skin sinks beside a blade that has not gone through it, for pictures that agree with what is felt.
#pragma once

#include <vector>

#include "haptic/surface_stiffness.h"

namespace cleft {

constexpr double dent_reach = 30;  ///< mm

/// Over how far it sinks under the blade, as under even pressure on the disc of surface_stiffness.h; led to
/// nothing at `reach`.
class SurfaceDent {
 public:
  SurfaceDent();                                 ///< of a half space
  explicit SurfaceDent(const SkinLayer& layer);  ///< of skin and tissue on their foundation
  /// Of what the field knows of its case.
  explicit SurfaceDent(const Field& field);

  double at(double distance) const;  ///< mm; 1 at 0

 private:
  std::vector<double> table_;  // at even distances
};

}  // namespace cleft
