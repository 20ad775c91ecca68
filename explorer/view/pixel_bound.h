// How far what moves in space moves in a picture at most.
#pragma once

#include <vtkRenderer.h>

#include <utility>

#include "base/vec3.h"

namespace cleft {

/// For places in a box, that are in the picture, seen in perspective. A place at the distance z from the
/// camera's plane that moves by d moves in the picture by at most
///   f d / (z - d) sqrt(1 + r^2 / f^2),   f = height / (2 tan(angle / 2)),
/// where r is its distance from the picture's middle: half the diagonal at most, and so far as it moves
/// beyond.
class PixelBound {
 public:
  /// The corners of the box, mm. A pixel of the picture is `samples` of the renderer's wide.
  PixelBound(vtkRenderer* renderer, const std::pair<Vec3, Vec3>& box, double samples);

  double pixels(double mm) const;  ///< infinite where there is no bound: the camera is in the box or beyond
  double mm(double pixels) const;  ///< the reverse; 0 there

 private:
  double nearest_, focal_, half_diagonal_;  // z of the box, f and r
};

}  // namespace cleft
