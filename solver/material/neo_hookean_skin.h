// Neo-Hookean skin: sigma_0 and a compressible neo-Hookean sheet in plane stress,
// W = sigma_0 : E + mu/2 (tr C + c - 3) - mu ln J + lambda/2 (ln J)^2, J^2 = c det C, C = I + 2 E in the
// plane, where c, the square of the stretch of the thickness, makes the stress across the sheet zero.
#pragma once

#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "solver/material/finite_skin.h"

namespace cleft {

struct NeoHookeanSkin {
  Eigen::Vector3d prestress;  ///< MPa: uu, vv, uv
  double shear, poisson;      ///< mu, MPa; nu from 0 to 1/2

  /// The stress across the sheet is zero where mu (c - 1) + lambda ln J = 0: with lambda = 2 mu nu / (1 - 2
  /// nu) this is (1 - 2 nu) (c - 1) + nu ln(c det C) = 0, which also holds without compressibility (nu =
  /// 1/2). Newton's iteration for the logarithm of c, of which this is a convex and increasing function.
  double thickness_stretch_squared(double determinant) const {
    double x = 0;
    for (int i = 0; i < 60; ++i) {
      const double c = std::exp(x);
      const double step = ((1 - 2 * poisson) * (c - 1) + poisson * (x + std::log(determinant))) /
                          ((1 - 2 * poisson) * c + poisson);
      x -= step;
      if (std::abs(step) < 1e-15 * (1 + std::abs(x))) break;
    }
    return std::exp(x);
  }

  /// S = sigma_0 + mu (I - c C^-1), as lambda ln J = -mu (c - 1).
  SkinResponse at(const Eigen::Vector3d& strain) const {
    SkinResponse r;
    Eigen::Matrix2d right;
    right << 1 + 2 * strain[0], strain[2], strain[2], 1 + 2 * strain[1];
    const double determinant = right.determinant();
    if (!(determinant > 0 && right(0, 0) > 0)) {
      r.energy = std::numeric_limits<double>::infinity();
      r.stress.setConstant(r.energy), r.tangent.setConstant(r.energy);
      return r;
    }
    const double c = thickness_stretch_squared(determinant), log_j = std::log(determinant * c) / 2;
    const Eigen::Matrix2d inverse = right.inverse();
    const Eigen::Vector3d p(inverse(0, 0), inverse(1, 1), inverse(0, 1));
    r.energy = strain.dot(prestress) + shear / 2 * (right.trace() + c - 3) - shear * log_j -
               shear / 2 * (c - 1) * log_j;
    r.stress = prestress - shear * c * p + Eigen::Vector3d(shear, shear, 0);
    Eigen::Matrix3d of_inverse;                           // C^-1 dC C^-1 = 2 (this) (E_uu, E_vv, 2 E_uv)
    of_inverse << p[0] * p[0], p[2] * p[2], p[0] * p[2],  //
        p[2] * p[2], p[1] * p[1], p[1] * p[2],            //
        p[0] * p[2], p[1] * p[2], (p[0] * p[1] + p[2] * p[2]) / 2;  //
    const double of_thickness = poisson * c / ((1 - 2 * poisson) * c + poisson);
    r.tangent = 2 * shear * (of_thickness * p * p.transpose() + c * of_inverse);
    return r;
  }
};

}  // namespace cleft
