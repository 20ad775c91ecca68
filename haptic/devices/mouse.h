// A device without hardware and force: a window or a script sets the pose.
#pragma once

#include "haptic/device.h"
#include "haptic/devices/device_kind.h"
#include "haptic/triple_buffer.h"

namespace cleft {

class Mouse : public Device {
 public:
  Mouse() : pose_(absent()) {}

  /// From one thread, at any time.
  void set(const ScalpelPose& pose) { pose_.write(pose); }
  /// The last force; called from the same thread.
  const Vec3& force() { return force_.read(); }

  ScalpelPose read(double) override { return pose_.read(); }
  void command(const Vec3& force) override { force_.write(force); }
  DeviceLimits limits() const override { return {}; }

 private:
  TripleBuffer<ScalpelPose> pose_;
  TripleBuffer<Vec3> force_;
};

inline DeviceKind mouse_device() {
  return {.name = "mouse",
          .title = "&Mouse: press to sink the blade",
          .help = "the pointer moves the blade over the skin, pressing sinks it",
          .in_window = true,
          .make = [](const DeviceRequest&) { return std::make_unique<Mouse>(); }};
}

}  // namespace cleft
