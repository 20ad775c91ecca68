// The stiffness of a case's skin under the blade, so that the force agrees with the picture.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "encoder/field/field.h"

namespace cleft {

constexpr double stiffness_radius = 2;  ///< mm, of the disc: docs/formats.md

/// N/mm, from the compliance c (mm/MPa) of the surface's middle under a disc of 2 mm radius that a snapshot
/// holds: the force pi a^2 p sinks the disc by c p.
double stiffness_from_compliance(double compliance);

/// A layer of tissue, or several, under a membrane, on springs that act in all directions: the solver's patch
/// without sides.
struct SkinLayer {
  double young_modulus, poisson_ratio;       ///< of the tissue, MPa
  double height;                             ///< mm
  double foundation;                         ///< N/mm^3, above 0
  double membrane;                           ///< of the skin, E t / (1 - nu^2), N/mm
  std::vector<TissueLayerBelow> below = {};  ///< further layers of other tissue, from above, on the springs
};

/// Compliances, mm/MPa, for the same disc at distances from its middle: the Hankel transform of the layer's
/// equations, solved for each wave number.
std::vector<double> layer_compliances(const SkinLayer& layer, std::span<const double> distances);
double layer_compliance(const SkinLayer& layer);  ///< in the disc's middle

/// N/mm: the force, over the depth, of a rigid flat punch of this radius (mm) without friction. Under its
/// pressure on a half space, which it keeps, and by the work of that pressure: exact there (Sneddon, The
/// relation between load and penetration, 1965), elsewhere too low by the square of what the pressure
/// differs.
double punch_stiffness(const SkinLayer& layer, double radius);

/// The profile of a half space relative to its middle (Johnson, Contact Mechanics, 3.4).
double half_space_profile(double distance);

/// The stiffness of a field's case, N/mm: from its quantity "compliance" at the middle of the cut if it has
/// one; else from its skin, tissue and foundation as a layer, within about 2 % of the solver's; else from its
/// tissue alone as a half space, 2 a (1 - nu^2) / E (Johnson, Contact Mechanics, 3.4). Throws InputError if
/// the field has none of these parameters.
double surface_stiffness(const Field& field);

/// A field's skin, tissue and foundation, if it has all their parameters; of a body the tissue below the
/// middle of its cut (Field::tissue).
std::optional<SkinLayer> skin_layer(const Field& field);
/// The same of parameters, of which those that are not known are NaN.
std::optional<SkinLayer> skin_layer(const Parameters& parameters);

}  // namespace cleft
