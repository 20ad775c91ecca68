// The quantities that a surface can be coloured by, evaluated from a field.
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

/// The value at a point: displacement and difference (from `reference`) in mm, gape (the opening between a
/// point and its mirror image across the cut) in mm, strain (the largest principal Green-Lagrange strain) as
/// a number; `tissue` is 0, and `error` is NaN, because it needs the simulation. `field` is evaluated at s mm
/// of the path.
double color_value(Coloring coloring, const VaryingField& field, const Field* reference, const Place& place,
                   double s = 0);

}  // namespace cleft
