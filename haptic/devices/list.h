// The table of devices: those of this program, and plug-ins that are found at run time (plugins.h). A new
// device is a file next to this one and a line in list.cpp.
#pragma once

#include "haptic/devices/device_kind.h"

namespace cleft {

/// The devices that are part of this program, in the order of menus and help texts.
const std::vector<DeviceKind>& built_in_devices();

/// The default device of `cleft haptic`: the first that needs no window.
const std::string& default_device();

/// The device of that name, built in or a plug-in. Throws InputError if there is none, naming the existing
/// ones, or if its plug-in cannot be used.
DeviceKind find_device(const std::string& name);

/// Throws InputError for an unknown name, or if a driver, the device or one of its parameters is missing.
std::unique_ptr<Device> make_device(const std::string& name, const DeviceRequest& request);

/// Names as help texts list them: "hand, recorded, ..., or the name of a plug-in".
std::string device_choices(bool in_window);
/// The same for the explorer's command, with the files that devices play: "mouse, hand PATH.csv, ...".
std::string device_usages();
/// The text of `cleft haptic --list-devices`: every device with its help, and every plug-in that cannot be
/// used with the reason.
std::string device_sheet();

}  // namespace cleft
