// The interface of devices for the loop. A device that blocks reads on a thread of its own and passes poses
// through a TripleBuffer: read() and command() are called from the haptic thread, and neither wait nor
// allocate memory.
#pragma once

#include <limits>

#include "haptic/force_parameters.h"
#include "haptic/pose.h"

namespace cleft {

class Device {
 public:
  virtual ~Device() = default;

  /// The pose at `time`, s since the loop began; `present` is false while the device is unplugged.
  virtual ScalpelPose read(double time) = 0;
  /// Sets the force, N, never above limits().max_force.
  virtual void command(const Vec3& force) = 0;
  virtual DeviceLimits limits() const = 0;
  /// s until its motion ends; infinite if a hand moves it.
  virtual double duration() const { return std::numeric_limits<double>::infinity(); }
};

}  // namespace cleft
