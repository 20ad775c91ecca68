// A picture of a view, drawn without a window.
#pragma once

#include <string>

#include "explorer/view/wound_view.h"

namespace cleft {

/// Draws `view` with four samples a pixel and writes a PNG of that size, whole or not at all. Throws
/// InputError where nothing can be drawn on this machine or the file cannot be written.
void write_picture(WoundView& view, int width, int height, const std::string& path);

}  // namespace cleft
