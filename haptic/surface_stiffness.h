// How stiff a case's skin is under the blade, so that it feels as it looks.
#pragma once

#include "encoder/field/field.h"

namespace cleft {

constexpr double stiffness_radius = 2;  ///< mm, of the disc: docs/formats.md

/// N/mm, from the compliance c (mm/MPa) of the surface's middle under a disc of 2 mm radius that a snapshot
/// holds: the force pi a^2 p sinks the disc by c p.
double stiffness_from_compliance(double compliance);

/// N/mm, of a field's tissue: from its quantity "compliance" at the middle of the cut where it has one; else
/// of the same disc on a half space of the tissue alone, 2 a (1 - nu^2) / E (Johnson, Contact
/// Mechanics, 3.4): no skin, no prestress, no bone. Throws InputError where the field tells neither.
double surface_stiffness(const Field& field);

}  // namespace cleft
