// The tissue's formulation where none is given.
#pragma once

#include "params/parameters/parameters.h"

namespace cleft {

/// The parameter. Cases that differ in it alone are the same case, simulated in two ways.
inline constexpr const char* formulation_name = "tissue.formulation";

/// Degrees by which a blade tilts against the normal of the skin at least, so that its lips end in a thin
/// edge.
constexpr double least_tilt = 10;

/// Linear wedges with displacements alone are too stiff where the skin bends the thin lip over a tilted
/// blade: tilted by 45 degrees a cut of 36 mm opens by 3.5 % too little in elements of 1 mm, and rightly with
/// mean dilatation. Takes that where a blade tilts by `degrees` or more to either side, and the elements and
/// the law have it. Upright, where both open alike, fields of displacements alone are smoother.
void settle_formulation(Parameters& parameters, double degrees);

}  // namespace cleft
