// Pictures, drawn without a window.
#pragma once

#include <string>

#include "explorer/session/session.h"
#include "explorer/view/wound_view.h"

namespace cleft {

/// Draws `view` with four samples for each pixel and writes a PNG of this size, completely or not at all.
/// Throws InputError if this machine cannot draw or the file cannot be written.
void write_picture(WoundView& view, int width, int height, const std::string& path);

/// The same for all that a session shows; `transparent`: without the background. The PNG holds the session's
/// state as text with this key.
void write_picture(Session& session, int width, int height, const std::string& path,
                   bool transparent = false);
inline constexpr const char* picture_state_key = "cleft-session";

/// The state in a picture, as JSON; throws FileError if there is none.
std::string state_in_picture(const std::string& path);

/// Mesh files and pictures for a session; answers go to `answer`.
SessionServices session_services(std::function<void(const std::string&)> answer);

}  // namespace cleft
