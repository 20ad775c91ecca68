#include "haptic/devices/list.h"

#include "base/error.h"
#include "base/text.h"
#include "haptic/devices/gamepad.h"
#include "haptic/devices/phantom.h"
#include "haptic/devices/recorded.h"
#include "haptic/devices/spacemouse.h"

namespace cleft {

namespace {

using Maker = std::unique_ptr<Device> (*)(const DeviceRequest&);
struct Kind {
  const char* name;
  Maker make;
};

const Kind kinds[] = {
    {"hand",
     [](const DeviceRequest& r) -> std::unique_ptr<Device> {
       if (r.script.empty()) throw InputError("the simulated hand follows the path of a cut: give --path");
       return std::make_unique<Hand>(r.hand, r.script);
     }},
    {"recorded",
     [](const DeviceRequest& r) -> std::unique_ptr<Device> {
       if (r.trajectory.empty()) throw InputError("the recorded device plays a file: give --trajectory");
       return std::make_unique<Recorded>(r.trajectory);
     }},
    {"spacemouse",
     [](const DeviceRequest& r) -> std::unique_ptr<Device> { return std::make_unique<SpaceMouse>(r.start); }},
    {"gamepad",
     [](const DeviceRequest& r) -> std::unique_ptr<Device> { return std::make_unique<Gamepad>(r.start); }},
    {"phantom",
     [](const DeviceRequest& r) -> std::unique_ptr<Device> { return std::make_unique<Phantom>(r.start); }},
};

}  // namespace

std::vector<std::string> device_names() {
  std::vector<std::string> names;
  for (const Kind& kind : kinds) names.push_back(kind.name);
  return names;
}

std::unique_ptr<Device> make_device(const std::string& name, const DeviceRequest& request) {
  for (const Kind& kind : kinds)
    if (name == kind.name) return kind.make(request);
  std::string known;
  for (const std::string& one : device_names()) known += (known.empty() ? "" : ", ") + one;
  throw InputError("--device " + name + ": there is none of that name" + did_you_mean(name, device_names()) +
                   "; there are " + known);
}

}  // namespace cleft
