// A trajectory file as a device: a recording is repeated bit for bit.
//
//   CSV with the columns time (s), x, y, z (tip, mm), ax, ay, az (axis), ex, ey, ez (edge), cutting, present
//   (0 or 1)
#pragma once

#include <string>
#include <vector>

#include "haptic/device.h"
#include "haptic/devices/device_kind.h"
#include "haptic/loop.h"

namespace cleft {

class Recorded : public Device {
 public:
  /// Throws FileError naming the row that is incomplete or out of order.
  explicit Recorded(const std::string& path);
  explicit Recorded(std::vector<RecordedPose> poses) : poses_(std::move(poses)) {}

  /// The last pose at or before `time`; the first one before it begins.
  ScalpelPose read(double time) override;
  void command(const Vec3&) override {}
  DeviceLimits limits() const override { return {}; }
  double duration() const override { return poses_.back().time; }

 private:
  std::vector<RecordedPose> poses_;
  std::size_t at_ = 0;
};

/// Writes a file for Recorded, completely or not at all; numbers are read back bit for bit.
void write_recording(const std::string& path, const std::vector<RecordedPose>& poses);

DeviceKind recorded_device();

}  // namespace cleft
