// The identity of a case's stiffness matrix, and how far two of them are apart.
#pragma once

#include <string>

#include "params/parameters/parameters.h"

namespace cleft {

/// The parameters on which K depends, as text: cases with equal texts have equal K and share its
/// factorisation. (In the finite model K is the tangent at the reference state, and all but the cut counts.)
std::string stiffness_key(Parameters parameters);

/// Those of stiffness_key() on which the mesh depends, as text: not moduli, springs and the skin's thickness.
std::string mesh_key(const Parameters& parameters);
/// The same for the mesh and the places of K's entries.
std::string pattern_key(const Parameters& parameters);

/// The parameters that make the mesh, and the order in which its cut opens, as text: all but moduli, springs,
/// the skin's thickness and tensions.
std::string mesh_and_release_key(Parameters parameters);
/// The case with moduli, springs and the skin's thickness of another one.
Parameters with_moduli_of(const Parameters& parameters, const Parameters& other);

/// Bounds of the stiffness of one case by that of another one of the same mesh: for all displacements u
///
///     least u . K(other) u  <=  u . K(one) u  <=  greatest u . K(other) u .
///
/// In the small model without the skin's prestress in it K is a sum of matrices without negative eigenvalues,
/// each times a modulus: of shear and of the change of volume, of the skin's shear and of its change of area,
/// of its bending, and of the springs. The bounds are the least and the greatest ratio of these moduli
/// (min-theta: Patera and Rozza, Reduced Basis Approximation, 2007).
struct StiffnessRatios {
  double least = 1, greatest = 1;
};
StiffnessRatios stiffness_ratios(const Parameters& one, const Parameters& other);

/// How the skin's prestress is a part of the stiffness (is_stiffened_by_prestress): "NAME = VALUE", and the
/// value without it.
struct PrestressSetting {
  std::string text, without;
};
PrestressSetting prestress_setting(const Parameters& parameters);

/// Throws InputError with the remedy if the equations of a case are not linear with such a stiffness: with
/// finite strains, contact, or a stiffness of the skin's prestress.
void check_linear(const Parameters& parameters, const std::string& where);

}  // namespace cleft
