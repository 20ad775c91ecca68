// The quantities that a surface can be coloured by, evaluated from a field.
#pragma once

#include <string>
#include <vector>

#include "explorer/wound/varying_field.h"

namespace cleft {

/// What a surface is coloured by; compares and converts as its kind does.
struct Coloring {
  enum Kind { tissue, own, displacement, gape, strain, difference, widening, error, quantity };
  Coloring(Kind of = displacement) : kind(of) {}  // NOLINT: a kind is a colouring
  explicit Coloring(std::string of_quantity) : kind(quantity), name(std::move(of_quantity)) {}
  friend bool operator==(const Coloring&, const Coloring&) = default;

  Kind kind;
  std::string name = {};  ///< of a further quantity of imported data
  std::string unit = {};  ///< of that, for legends, where it is known
};

struct ColoringText {
  Coloring coloring;
  std::string name;   ///< as in commands
  std::string title;  ///< with its unit, as in legends
  std::string help;
};
/// Whether the surface looks as it is: there are no values and no legend.
inline bool is_look(const Coloring& coloring) {
  return coloring == Coloring::tissue || coloring == Coloring::own;
}
/// Whether its values go to both sides of 0.
inline bool is_signed(const Coloring& coloring) { return coloring == Coloring::widening; }
/// Whether it is relative to another case.
inline bool needs_reference(const Coloring& coloring) {
  return coloring == Coloring::difference || coloring == Coloring::widening;
}

/// Of all but quantities.
const std::vector<ColoringText>& colorings();
/// A quantity has the name quantity:NAME, and its own as title, with its unit where that is known.
ColoringText text_of(const Coloring& coloring);
/// By the name of a colouring, of one of the `quantities`, or quantity:NAME. Throws InputError for an unknown
/// name, with the nearest one.
Coloring coloring_of(const std::string& name, const std::vector<std::string>& quantities = {});

/// The value at a point: displacement and difference (from `reference`) in mm, gape (the opening between a
/// point and its mirror image across the cut) in mm, widening (the gape less that of `reference`) in mm,
/// strain (the largest principal Green-Lagrange strain) as a number; a quantity in its own unit, of vectors
/// and tensors their magnitude (NaN where the field has none of that name); `tissue` is 0, and `error` is
/// NaN, because it needs the simulation. `field` is evaluated at s mm of the path.
double color_value(const Coloring& coloring, const VaryingField& field, const Field* reference,
                   const Place& place, double s = 0);

}  // namespace cleft
