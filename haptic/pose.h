// The pose of the scalpel.
#pragma once

#include "base/vec3.h"

namespace cleft {

/// mm, in the mesh's space times its scale.
struct ScalpelPose {
  Vec3 tip;
  Vec3 axis{0, 0, 1};   ///< unit, from the tip along the blade to the handle
  Vec3 edge{1, 0, 0};   ///< unit, the direction in which the edge cuts
  bool cutting = true;  ///< whether the blade may cut: a button, and false without a device
  bool present = true;  ///< whether there is a device; without one there is neither contact nor force

  friend bool operator==(const ScalpelPose&, const ScalpelPose&) = default;
};

/// The pose while there is no device.
inline ScalpelPose absent(ScalpelPose pose = {}) {
  pose.present = pose.cutting = false;
  return pose;
}

}  // namespace cleft
