// Neo-Hookean tissue, whose energy is a sum of parts of the change of shape and of the change of volume:
// W = mu/2 (J^(-2/3) tr F^T F - 3) + kappa/2 (J - 1)^2.
#pragma once

#include <cmath>

#include "params/material/isotropic.h"
#include "solver/material/finite_tissue.h"

namespace cleft {

struct NeoHookeanTissue {
  Isotropic moduli;  ///< MPa: those of the linear law are the tangents at F = I

  static constexpr bool has_volume = true;

  VolumeEnergy volume(double j) const {
    return {moduli.bulk / 2 * (j - 1) * (j - 1), moduli.bulk * (j - 1), moduli.bulk};
  }

  struct State {
    const Deformation& f;
    double factor, trace, energy;  // mu J^(-2/3), tr F^T F

    Eigen::Vector3d force(int a) const { return factor * (f.carried.col(a) - trace / 3 * f.spatial.col(a)); }

    PointTangent tangent() const {
      return {.spatial = 2. / 9 * trace * factor,
              .mixed = -2. / 3 * factor,
              .crossed_spatial = trace / 3 * factor,
              .even = factor};
    }
  };

  State at(const Deformation& f) const {
    const double root = std::cbrt(f.determinant), factor = moduli.shear / (root * root);
    const double trace = f.gradient.squaredNorm();
    return {f, factor, trace, (factor * trace - 3 * moduli.shear) / 2};
  }
};

}  // namespace cleft
