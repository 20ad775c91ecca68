// The level of detail: vertices that never move by more stay at rest and are not evaluated.
#pragma once

#include <cstddef>
#include <string>

namespace cleft {

/// Above 0, in micrometres or in pixels of the picture.
struct Detail {
  double amount = 0;
  bool pixels = false;
};

/// "10um" or "0.25px", and back. Throws InputError for any other text.
std::string text_of(const Detail& detail);
Detail detail_of(const std::string& text);

/// The vertices that a scene leaves out.
struct LeftOut {
  std::size_t vertices = 0, of = 0;  ///< among those that a field moves, counted for every cut
  double error = 0;                  ///< bound of their error, mm
};

}  // namespace cleft
