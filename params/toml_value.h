// Common functions of the readers of a study file.
#pragma once

#include <toml++/toml.h>

#include <string>

#include "params/parameters/table.h"

namespace cleft {

/// Throws InputError "<path>, line <n>: what is wrong".
toml::table parse_toml(const std::string& text, const std::string& path);

/// "<path>, line <n>"
std::string place_of(const std::string& path, const toml::node& node);

/// The value that a file gives to the parameter `name`, unchecked; throws InputError if there is no such
/// parameter, or the value is neither number, text nor switch.
Value value_of(const toml::node& node, const std::string& name, const std::string& where);

}  // namespace cleft
