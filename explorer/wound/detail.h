// The level of detail: what never moves by more than that is left at rest, and not evaluated.
#pragma once

#include <cstddef>
#include <string>

namespace cleft {

/// Above 0, in micrometres or in pixels of the picture.
struct Detail {
  double amount = 0;
  bool pixels = false;
};

/// "10um" or "0.25px", and back. Throws InputError where a text is neither.
std::string text_of(const Detail& detail);
Detail detail_of(const std::string& text);

/// What a scene leaves out.
struct LeftOut {
  std::size_t vertices = 0, of = 0;  ///< that a field moves, counted for every cut
  double error = 0;                  ///< mm by which they are off at most
};

}  // namespace cleft
