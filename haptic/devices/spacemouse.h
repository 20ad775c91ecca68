// A SpaceMouse through spacenavd (libspnav, loaded at run time): pushing moves, twisting turns, button 1
// cuts. It has no motors and renders no force. The daemon's socket is that of SPNAV_SOCKET, else its own
// default.
#pragma once

#include <atomic>
#include <memory>
#include <thread>

#include "haptic/device.h"
#include "haptic/devices/device_kind.h"
#include "haptic/devices/rate_control.h"
#include "haptic/triple_buffer.h"

namespace cleft {

class SpaceMouse : public Device {
 public:
  /// Throws InputError if libspnav or the daemon is missing. One SpaceMouse at a time: libspnav has one
  /// connection.
  explicit SpaceMouse(const ScalpelPose& start);
  ~SpaceMouse() override;

  ScalpelPose read(double time) override { return pose_.advance(deflection_.read(), time); }
  void command(const Vec3&) override {}
  DeviceLimits limits() const override { return {}; }

 private:
  struct Library;
  void watch();
  bool handle_events(Deflection& d);

  std::unique_ptr<Library> spnav_;
  RateControl pose_;
  TripleBuffer<Deflection> deflection_;
  std::atomic<bool> stop_{false};
  std::thread watcher_;
};

DeviceKind spacemouse_device();

}  // namespace cleft
