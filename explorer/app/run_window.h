// The explorer's window.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "explorer/session/session.h"

namespace cleft {

/// Opens a window of this size in pixels, by default as it was closed last, runs a first command if one is
/// given, and returns when the window is closed. Throws InputError if there is no display.
void run_window(Session& session, const std::optional<std::array<int, 2>>& size, const std::string& line);

}  // namespace cleft
