// The explorer's window.
#pragma once

#include "explorer/scene/session/session.h"

namespace cleft {

/// Opens a window of that size in pixels and reacts until it is closed. Throws InputError where there is no
/// display.
void run_window(Session& session, int width, int height);

}  // namespace cleft
