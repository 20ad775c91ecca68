// Every device by name. A new one is a file beside this and a line in list.cpp.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "haptic/device.h"
#include "haptic/devices/hand.h"

namespace cleft {

/// What devices are made from; each takes what it needs.
struct DeviceRequest {
  ScalpelPose start;       ///< where a device that tells only motions begins
  std::string trajectory;  ///< file of the recorded device
  HandParameters hand;
  std::vector<HandTarget> script;  ///< of the hand
};

std::vector<std::string> device_names();

/// Throws InputError for an unknown name, and where a driver, the device or what it is made from is missing.
std::unique_ptr<Device> make_device(const std::string& name, const DeviceRequest& request);

}  // namespace cleft
