// Tissue with linear isotropic elasticity.
#pragma once

#include "params/material/isotropic.h"
#include "solver/material/tissue_material.h"

namespace cleft {

struct LinearIsotropic {
  Isotropic moduli;  ///< MPa

  /// mu (b_i a_j + a.b delta_ij - 2/3 a_i b_j) of the gradients of the strain, and kappa a_i b_j of those of
  /// the change of volume.
  dealii::Tensor<2, 3> stiffness(const ShapeGradient& a, const ShapeGradient& b) const {
    const double mu = moduli.shear;
    dealii::Tensor<2, 3> k =
        mu * outer_product(b.strain, a.strain) - 2. / 3 * mu * outer_product(a.strain, b.strain);
    const double both = mu * (a.strain * b.strain);
    for (unsigned d = 0; d < 3; ++d) k[d][d] += both;
    return k + moduli.bulk * outer_product(a.dilatation, b.dilatation);
  }
};

}  // namespace cleft
