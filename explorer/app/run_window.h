// The explorer's window.
#pragma once

#include "explorer/session/session.h"

namespace cleft {

/// Opens a window of this size in pixels, runs a first command if one is given, and returns when the window
/// is closed. Throws InputError if there is no display.
void run_window(Session& session, int width, int height, const std::string& line);

}  // namespace cleft
