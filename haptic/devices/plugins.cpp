#include "haptic/devices/plugins.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <sstream>

#include "base/error.h"
#include "base/process.h"
#include "base/text.h"
#include "haptic/devices/plugin.h"
#include "haptic/devices/shared_library.h"

namespace cleft {

namespace {

namespace fs = std::filesystem;

cleft_device_pose to_c(const ScalpelPose& pose) {
  return {{pose.tip.x, pose.tip.y, pose.tip.z},
          {pose.axis.x, pose.axis.y, pose.axis.z},
          {pose.edge.x, pose.edge.y, pose.edge.z},
          pose.cutting,
          pose.present};
}

/// A pose that is no pose (a coordinate that is not finite, a direction without length) is an unplugged
/// device: the forces that would follow from it are not safe.
ScalpelPose from_c(const cleft_device_pose& c) {
  constexpr double shortest_direction = 0.5;  // of a vector that should have the length 1
  ScalpelPose pose;
  pose.tip = {c.tip[0], c.tip[1], c.tip[2]};
  pose.axis = {c.axis[0], c.axis[1], c.axis[2]};
  pose.edge = {c.edge[0], c.edge[1], c.edge[2]};
  pose.cutting = c.cutting != 0;
  const double axis = norm(pose.axis), edge = norm(pose.edge);
  const bool sound = std::isfinite(pose.tip.x + pose.tip.y + pose.tip.z + axis + edge) &&
                     std::min(axis, edge) > shortest_direction;
  if (c.present == 0 || !sound) return absent();
  pose.axis = 1 / axis * pose.axis;
  pose.edge = 1 / edge * pose.edge;
  return pose;
}

/// A plug-in's library and what it exports, loaded and checked. The library stays loaded.
struct Plugin {
  SharedLibrary library;
  const cleft_device_plugin* device = nullptr;

  explicit Plugin(const std::string& file)
      : library(plugin_name(file), file, "it is no shared library for this machine, or lacks one itself") {
    decltype(cleft_device)* entry = nullptr;
    library.find(entry, "cleft_device");
    device = entry();
    const auto refuse = [&](const std::string& why) {
      throw InputError(plugin_name(file) + ": " + file + " " + why);
    };
    if (!device) refuse("has an entry point cleft_device that returns nothing");
    if (device->version != CLEFT_DEVICE_VERSION)
      refuse("was made for version " + std::to_string(device->version) +
             " of the device interface, and this program has version " +
             std::to_string(CLEFT_DEVICE_VERSION) + ": build it again with haptic/devices/plugin.h of " +
             producer());
    if (!device->name || !device->title || !device->help || !device->open || !device->read ||
        !device->command || !device->limits || !device->close)
      refuse("lacks a text or a function of the device interface: fill in all of cleft_device_plugin");
    if (device->name != plugin_name(file))
      refuse("names itself '" + std::string(device->name) + "': a device NAME is the file NAME.so");
  }
};

class PluginDevice : public Device {
 public:
  PluginDevice(std::shared_ptr<const Plugin> plugin, const ScalpelPose& start) : plugin_(std::move(plugin)) {
    const cleft_device_pose from = to_c(start);
    char error[1024] = "";
    handle_ = api().open(&from, error, sizeof error);
    error[sizeof error - 1] = 0;
    const std::string name = api().name;
    if (!handle_) throw InputError(name + ": " + (*error ? error : "the device cannot be opened"));
    cleft_device_limits limits{};
    api().limits(handle_, &limits);
    limits_ = {limits.max_force, limits.max_stiffness, limits.max_damping, limits.latency};
    if (std::isfinite(limits_.max_force + limits_.max_stiffness + limits_.max_damping + limits_.latency) &&
        std::min(limits_.max_force, limits_.max_stiffness) > 0 &&
        std::min(limits_.max_damping, limits_.latency) >= 0)
      return;
    api().close(handle_);
    throw InputError(name +
                     ": its limits must be finite, the force and the stiffness above 0, and the damping "
                     "and the latency at least 0");
  }
  ~PluginDevice() override { api().close(handle_); }
  PluginDevice(const PluginDevice&) = delete;
  PluginDevice& operator=(const PluginDevice&) = delete;

  ScalpelPose read(double time) override {
    cleft_device_pose pose{};
    api().read(handle_, time, &pose);
    return from_c(pose);
  }
  void command(const Vec3& force) override {
    const double components[3] = {force.x, force.y, force.z};
    api().command(handle_, components);
  }
  DeviceLimits limits() const override { return limits_; }

 private:
  const cleft_device_plugin& api() const { return *plugin_->device; }

  std::shared_ptr<const Plugin> plugin_;
  void* handle_ = nullptr;
  DeviceLimits limits_;
};

}  // namespace

std::vector<std::string> plugin_folders() {
  std::vector<std::string> folders;
  if (const char* named = std::getenv("CLEFT_DEVICES")) {
    std::istringstream list(named);
    for (std::string folder; std::getline(list, folder, ':');)
      if (!folder.empty()) folders.push_back(fs::absolute(folder).lexically_normal().string());
  }
  folders.push_back((fs::path(executable_folder()) / "../lib/cleft/devices").lexically_normal().string());
  return folders;
}

std::vector<std::string> plugin_files() {
  std::vector<std::string> all;
  for (const std::string& folder : plugin_folders()) {
    std::vector<std::string> here;
    std::error_code missing;  // a folder that is not there holds no plug-ins
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, missing))
      if (entry.path().extension() == ".so") here.push_back(entry.path().string());
    std::sort(here.begin(), here.end());
    all.insert(all.end(), here.begin(), here.end());
  }
  return all;
}

std::string plugin_name(const std::string& file) { return fs::path(file).stem().string(); }

DeviceKind plugin_device(const std::string& file) {
  const auto plugin = std::make_shared<const Plugin>(file);
  DeviceKind kind;
  kind.name = plugin->device->name;
  kind.title = plugin->device->title;
  kind.help = plugin->device->help;
  kind.make = [plugin](const DeviceRequest& request) {
    return std::make_unique<PluginDevice>(plugin, request.start);
  };
  kind.file = file;
  return kind;
}

}  // namespace cleft
