// The colours of values, as numbers and without VTK.
#pragma once

#include <array>
#include <string>
#include <vector>

namespace cleft {

struct ColorMap {
  std::string name, help;
  bool diverging;  ///< from a neutral middle to two sides
  /// Red, green, blue, 0 to 1, at even distances; between them the colours are even in CIELAB.
  std::vector<std::array<double, 3>> stops;
};

/// The first is that of values, the last that of signed values, unless another is asked for.
const std::vector<ColorMap>& color_maps();

/// Throws InputError with the nearest name if there is none.
const ColorMap& color_map(const std::string& name);

/// The names, with | between.
std::string color_map_names();

}  // namespace cleft
