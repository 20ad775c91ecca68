// Linear isotropic elasticity, stated once for the solver and for the explorer: the moduli and stresses that
// Young's modulus E and Poisson's ratio nu give in a body and in a sheet under plane stress. docs/formats.md,
// "What the displacements solve", writes the equations out.
#pragma once

#include <array>

namespace cleft {

/// A body. The moduli have the unit of Young's modulus.
struct Isotropic {
  double shear;  ///< mu = E / (2 (1 + nu))
  double bulk;   ///< kappa = E / (3 (1 - 2 nu))
  double lame;   ///< lambda = 2 mu nu / (1 - 2 nu), which is kappa - 2/3 mu

  Isotropic(double young_modulus, double poisson_ratio)
      : shear(young_modulus / (2 * (1 + poisson_ratio))),
        bulk(young_modulus / (3 * (1 - 2 * poisson_ratio))),
        lame(2 * shear * poisson_ratio / (1 - 2 * poisson_ratio)) {}

  /// n . sigma n for a unit vector n, from n . e n and the trace of the strain e: 2 mu n . e n + lambda tr e.
  double normal_stress(double normal_strain, double trace) const {
    return 2 * shear * normal_strain + lame * trace;
  }
};

/// A sheet in plane stress. With a Young's modulus of E times the thickness (N/mm) in place of E, stresses
/// are forces for each mm of a line across the sheet.
struct IsotropicSheet {
  double modulus;  ///< E / (1 - nu^2)
  double poisson_ratio;

  IsotropicSheet(double young_modulus, double poisson)
      : modulus(young_modulus / (1 - poisson * poisson)), poisson_ratio(poisson) {}

  /// Stress (uu, vv, uv) of a strain (e_uu, e_vv, 2 e_uv), in Voigt's notation.
  std::array<std::array<double, 3>, 3> elasticity() const {
    const double nu = poisson_ratio;
    return {{{modulus, modulus * nu, 0}, {modulus * nu, modulus, 0}, {0, 0, modulus * ((1 - nu) / 2)}}};
  }

  /// n . sigma n for a unit vector n in the plane, from n . e n and the trace of the strain in the plane.
  double normal_stress(double normal_strain, double trace) const {
    return modulus * ((1 - poisson_ratio) * normal_strain + poisson_ratio * trace);
  }
};

}  // namespace cleft
