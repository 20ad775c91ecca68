// A bound of motions in a picture for motions in space.
#pragma once

#include <vtkRenderer.h>

#include <utility>

#include "base/vec3.h"

namespace cleft {

/// For places of a box that are in the picture, in perspective. A place at the distance z from the camera's
/// plane that moves by d moves in the picture by at most
///   f d / (z - d) sqrt(1 + r^2 / f^2),   f = height / (2 tan(angle / 2)),
/// where r is its distance from the picture's middle: at most half the diagonal, plus the motion beyond it.
class PixelBound {
 public:
  /// The corners of the box, mm. A pixel of the picture is `samples` pixels of the renderer wide.
  PixelBound(vtkRenderer* renderer, const std::pair<Vec3, Vec3>& box, double samples);

  double pixels(double mm) const;  ///< infinite if there is no bound: the camera is in the box or beyond it
  double mm(double pixels) const;  ///< the inverse; 0 without a bound

 private:
  double nearest_, focal_, half_diagonal_;  // z of the box, f and r
};

}  // namespace cleft
