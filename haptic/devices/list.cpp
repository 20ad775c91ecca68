#include "haptic/devices/list.h"

#include <algorithm>

#include "base/error.h"
#include "base/text.h"
#include "haptic/devices/gamepad.h"
#include "haptic/devices/mouse.h"
#include "haptic/devices/phantom.h"
#include "haptic/devices/plugins.h"
#include "haptic/devices/recorded.h"
#include "haptic/devices/spacemouse.h"

namespace cleft {

namespace {

/// The sheet's line of a device or of a file.
std::string row(const std::string& name, const std::string& text) {
  constexpr std::size_t column = 14;
  return name + std::string(name.size() < column ? column - name.size() : 1, ' ') + text + "\n";
}

std::string details(const DeviceKind& kind) {
  std::string text = kind.help;
  if (kind.input) text += std::string("; needs ") + kind.input->option;
  if (kind.in_window) text += "; in the window of cleft explore";
  if (!kind.file.empty()) text += " (" + kind.file + ")";
  return text;
}

}  // namespace

const std::vector<DeviceKind>& built_in_devices() {
  static const std::vector<DeviceKind> kinds{mouse_device(),      hand_device(),    recorded_device(),
                                             spacemouse_device(), gamepad_device(), phantom_device()};
  return kinds;
}

const std::string& default_device() {
  return std::find_if(built_in_devices().begin(), built_in_devices().end(),
                      [](const DeviceKind& kind) { return !kind.in_window; })
      ->name;
}

DeviceKind find_device(const std::string& name) {
  std::vector<std::string> names;
  for (const DeviceKind& kind : built_in_devices()) {
    if (kind.name == name) return kind;
    names.push_back(kind.name);
  }
  for (const std::string& file : plugin_files()) {
    if (plugin_name(file) == name) return plugin_device(file);
    names.push_back(plugin_name(file));
  }
  std::string known;
  for (const std::string& one : names) known += (known.empty() ? "" : ", ") + one;
  throw InputError("--device " + name + ": there is none of that name" + did_you_mean(name, names) +
                   "; there are " + known);
}

std::unique_ptr<Device> make_device(const std::string& name, const DeviceRequest& request) {
  return find_device(name).make(request);
}

std::string device_choices(bool in_window) {
  std::string text;
  for (const DeviceKind& kind : built_in_devices())
    if (in_window || !kind.in_window) text += kind.name + ", ";
  return text + "or the name of a plug-in";
}

std::string device_usages() {
  std::string text;
  for (const DeviceKind& kind : built_in_devices())
    text +=
        (text.empty() ? "" : ", ") + kind.name + (kind.input ? std::string(" ") + kind.input->argument : "");
  return text;
}

std::string device_sheet() {
  std::string sheet, unusable;
  std::vector<std::string> names;
  for (const DeviceKind& kind : built_in_devices()) {
    sheet += row(kind.name, details(kind));
    names.push_back(kind.name);
  }
  for (const std::string& file : plugin_files()) {
    const std::string name = plugin_name(file);
    if (std::find(names.begin(), names.end(), name) != names.end()) {
      unusable += row(name, name + ": " + file + " has the name of a device above: rename it");
      continue;
    }
    names.push_back(name);
    try {
      sheet += row(name, details(plugin_device(file)));
    } catch (const InputError& e) {
      unusable += row(name, e.what());
    }
  }
  if (!unusable.empty()) sheet += "\nPlug-ins that cannot be used:\n" + unusable;
  sheet += "\nPlug-ins are the files NAME.so in";
  for (const std::string& folder : plugin_folders()) sheet += " " + folder;
  return sheet + "\n(the folders of CLEFT_DEVICES, separated by colons, and the program's own).\n";
}

}  // namespace cleft
