// A row of the table of devices (list.h): everything that help texts, menus, error messages and the window
// know of a device. Each device states its row in its own file.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "haptic/device.h"
#include "haptic/devices/hand.h"

namespace cleft {

/// What devices are made from; each takes what it needs.
struct DeviceRequest {
  ScalpelPose start;       ///< where a device that reports only motions begins
  std::string trajectory;  ///< file of a device whose input is `recording_input`
  HandParameters hand;
  std::vector<HandTarget> script;  ///< over the path of a device whose input is `path_input`
};

/// A file that a device plays, and how it is asked for.
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
  /// The file that the device plays; null where a hand moves it.
  const DeviceInput* input = nullptr;
  /// Whether its pose is set by the pointer in the explorer's window: `cleft haptic` has none.
  bool in_window = false;
  /// Throws InputError where a driver, the device or what it is made from is missing.
  std::function<std::unique_ptr<Device>(const DeviceRequest&)> make;
  std::string file = {};  ///< of a plug-in; empty: part of this program
};

}  // namespace cleft
