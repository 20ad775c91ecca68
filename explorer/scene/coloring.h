// What a surface can be coloured by, evaluated from a field.
#pragma once

#include <string>
#include <vector>

#include "explorer/wound/varying_field.h"

namespace cleft {

enum class Coloring { tissue, displacement, gape, strain, difference, error };

struct ColoringText {
  Coloring coloring;
  std::string name;   ///< as in commands
  std::string title;  ///< with its unit, as in legends
  std::string help;
};
const std::vector<ColoringText>& colorings();
const ColoringText& text_of(Coloring coloring);
/// Throws InputError for an unknown name, with the nearest one.
Coloring coloring_of(const std::string& name);

/// The value at a point: displacement and difference (from `reference`) in mm, gape in mm, on both sides
/// of the cut that between a point and its mirror image, the largest principal Green-Lagrange strain as a
/// number. `tissue` has none: 0. Of `error` a field knows nothing: not a number.
/// `field` is taken at s mm of the path.
double color_value(Coloring coloring, const VaryingField& field, const Field* reference, const Place& place,
                   double s = 0);

}  // namespace cleft
