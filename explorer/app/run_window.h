// The explorer's window.
#pragma once

#include "explorer/session/session.h"

namespace cleft {

/// Opens a window of that size in pixels, says a line in it where there is one, and reacts until it is
/// closed. Throws InputError where there is no display.
void run_window(Session& session, int width, int height, const std::string& line);

}  // namespace cleft
