// A gamepad through SDL2 (loaded at run time): the left stick moves, the right stick lifts and turns, A cuts.
// Contact is rendered as rumble proportional to the force.
#pragma once

#include <atomic>
#include <memory>
#include <thread>

#include "haptic/device.h"
#include "haptic/devices/device_kind.h"
#include "haptic/devices/rate_control.h"
#include "haptic/triple_buffer.h"

namespace cleft {

class Gamepad : public Device {
 public:
  /// Throws InputError if SDL2 or a gamepad is missing.
  explicit Gamepad(const ScalpelPose& start);
  ~Gamepad() override;

  ScalpelPose read(double time) override { return pose_.advance(deflection_.read(), time); }
  void command(const Vec3& force) override { force_.write(norm(force)); }
  DeviceLimits limits() const override { return {}; }

 private:
  struct Library;
  void watch();
  bool open();
  void close();
  Deflection look() const;
  void rumble();

  std::unique_ptr<Library> sdl_;
  RateControl pose_;
  TripleBuffer<Deflection> deflection_;
  TripleBuffer<double> force_;
  double rumbling_ = 0;
  std::atomic<bool> stop_{false};
  std::thread watcher_;
};

DeviceKind gamepad_device();

}  // namespace cleft
