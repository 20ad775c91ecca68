// A row of the table of devices (list.h): all data of a device for help texts, menus, error messages and the
// window. Each device states its row in its own file.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "haptic/device.h"
#include "haptic/devices/hand.h"

namespace cleft {

/// The parameters from which devices are made; each uses those that it needs.
struct DeviceRequest {
  ScalpelPose start;       ///< start of a device that reports only motions
  std::string trajectory;  ///< file of a device whose input is `recording_input`
  HandParameters hand;
  std::vector<HandTarget> script;  ///< over the path of a device whose input is `path_input`
};

/// A file that a device plays, and its names in options and dialogs.
struct DeviceInput {
  const char* option;    ///< of `cleft haptic`
  const char* argument;  ///< after the name in the explorer's command `device`
  const char* filter;    ///< of file dialogs
};
inline constexpr DeviceInput path_input{"--path", "PATH.csv", "Paths (*.csv)"};
inline constexpr DeviceInput recording_input{"--trajectory", "POSES.csv", "Recordings (*.csv)"};

struct DeviceKind {
  std::string name;   ///< of --device, lower case
  std::string title;  ///< in menus, with & before the letter that chooses it
  std::string help;   ///< one sentence, without a full stop
  /// The file that the device plays; null if a hand moves it.
  const DeviceInput* input = nullptr;
  /// Whether its pose is set by the pointer in the explorer's window: `cleft haptic` has none.
  bool in_window = false;
  /// Throws InputError if a driver, the device or one of its parameters is missing.
  std::function<std::unique_ptr<Device>(const DeviceRequest&)> make;
  std::string file = {};  ///< of a plug-in; empty: part of this program
};

}  // namespace cleft
