// Devices that are shared libraries, found at run time: files NAME.so with the C entry point of plugin.h.
#pragma once

#include <string>
#include <vector>

#include "haptic/devices/device_kind.h"

namespace cleft {

/// The folders that are searched, in this order: those of CLEFT_DEVICES, separated by colons, and
/// ../lib/cleft/devices seen from the program's folder (of an installation, or of a build).
std::vector<std::string> plugin_folders();

/// The files NAME.so there, by folder and then by name. None is loaded.
std::vector<std::string> plugin_files();

/// NAME of a file .../NAME.so.
std::string plugin_name(const std::string& file);

/// Loads the file. Throws InputError if it cannot be loaded, lacks the entry point or a function, was made
/// for another version of the interface, or has another name than its file.
DeviceKind plugin_device(const std::string& file);

}  // namespace cleft
