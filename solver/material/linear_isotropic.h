// Linear isotropic elasticity of the tissue.
#pragma once

#include <deal.II/base/tensor.h>

#include "params/parameters.h"

namespace cleft {

/// Moduli in MPa.
struct LinearIsotropic {
  double bulk, shear;

  explicit LinearIsotropic(const Parameters::Tissue& t)
      : bulk(t.young_modulus / (3 * (1 - 2 * t.poisson_ratio))),
        shear(t.young_modulus / (2 * (1 + t.poisson_ratio))) {}

  /// Contribution of a point to the stiffness between two shape functions with gradients a and b, without the
  /// change of volume: mu (b_i a_j + a.b delta_ij - 2/3 a_i b_j).
  dealii::Tensor<2, 3> deviatoric(const dealii::Tensor<1, 3>& a, const dealii::Tensor<1, 3>& b) const {
    dealii::Tensor<2, 3> k = shear * outer_product(b, a) - 2. / 3 * shear * outer_product(a, b);
    const double both = shear * (a * b);
    for (unsigned d = 0; d < 3; ++d) k[d][d] += both;
    return k;
  }

  /// Contribution of the change of volume: kappa a_i b_j.
  dealii::Tensor<2, 3> volumetric(const dealii::Tensor<1, 3>& a, const dealii::Tensor<1, 3>& b) const {
    return bulk * outer_product(a, b);
  }
};

}  // namespace cleft
