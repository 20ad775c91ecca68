// Rate control: devices that spring back report velocities; their pose is the integral.
#pragma once

#include <algorithm>

#include "haptic/pose.h"

namespace cleft {

/// Parts of the full deflection, -1 to 1, in the mesh's directions.
struct Deflection {
  Vec3 move, turn;
  bool cutting = false, present = false;
};

class RateControl {
 public:
  static constexpr double speed = 50;   ///< mm/s at full deflection
  static constexpr double turning = 1;  ///< rad/s

  explicit RateControl(const ScalpelPose& start) : pose_(start) {}

  /// The pose at `time`, s; a gap counts as a tenth of a second at most.
  ScalpelPose advance(const Deflection& d, double time) {
    const double dt = std::clamp(time - time_, 0., 0.1);
    time_ = time;
    pose_.present = d.present;
    pose_.cutting = d.cutting && d.present;
    if (!d.present) return pose_;
    pose_.tip += dt * speed * d.move;
    const Vec3 angle = dt * turning * d.turn;
    pose_.axis = normalized(pose_.axis + cross(angle, pose_.axis));
    const Vec3 edge = pose_.edge + cross(angle, pose_.edge);
    pose_.edge = normalized(edge - dot(edge, pose_.axis) * pose_.axis);
    return pose_;
  }

 private:
  ScalpelPose pose_;
  double time_ = 0;
};

}  // namespace cleft
