// The paper's device: a PHANToM (Touch, Omni, Desktop, Premium) through OpenHaptics' HD interface. The
// library is loaded at run time and its functions are declared from its public documentation (OpenHaptics
// Toolkit, API Reference): building needs nothing proprietary.
//
// The device's own servo thread reads the pose and sets the force, one tick late.
#pragma once

#include <atomic>
#include <memory>
#include <string>
#include <thread>

#include "haptic/device.h"
#include "haptic/devices/device_kind.h"
#include "haptic/triple_buffer.h"

namespace cleft {

class Phantom : public Device {
 public:
  /// The middle of the device's workspace is `start`'s tip. Throws InputError if the library or the device is
  /// missing, or the device is not calibrated.
  explicit Phantom(const ScalpelPose& start, const std::string& library = "libHD.so");
  ~Phantom() override;

  ScalpelPose read(double time) override;
  void command(const Vec3& force) override { force_.write(force); }
  DeviceLimits limits() const override { return limits_; }

 private:
  struct Library;
  static unsigned servo(void* self);
  void tick();
  void open();
  void close();
  void watch();

  ScalpelPose start_;
  Vec3 middle_;  ///< of the workspace, in the mesh's directions, mm
  std::unique_ptr<Library> hd_;
  DeviceLimits limits_;
  TripleBuffer<ScalpelPose> pose_;
  TripleBuffer<Vec3> force_;
  std::atomic<bool> lost_{false}, stop_{false};
  std::thread watcher_;
};

DeviceKind phantom_device();

}  // namespace cleft
