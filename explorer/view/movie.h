// A movie of the growing cut.
#pragma once

#include <string>

#include "explorer/session/session.h"

namespace cleft {

/// From nothing cut to the end, at the speed of playing: Ogg Theora where the name ends in .ogv, else a
/// folder of frame_0000.png, ... Whole or not at all; the session is then as it was. Throws InputError where
/// the name is taken by what is no such folder or the user wants no more of it, std::runtime_error where the
/// disk is full.
void write_movie(Session& session, const std::string& file, const MovieFormat& format);

}  // namespace cleft
