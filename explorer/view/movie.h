// A movie of the growing cut.
#pragma once

#include <string>

#include "explorer/session/session.h"

namespace cleft {

/// Writes a movie from uncut to completely cut at the speed of playing: Ogg Theora if the name ends in .ogv,
/// else a folder of frame_0000.png, ... Complete or not at all; the session is unchanged afterwards. Throws
/// InputError if the name exists and is not such a folder, or the user cancels; std::runtime_error if the
/// disk is full.
void write_movie(Session& session, const std::string& file, const MovieFormat& format);

}  // namespace cleft
