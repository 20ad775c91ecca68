// Linear isotropic elasticity of the tissue.
#pragma once

#include <deal.II/base/tensor.h>

namespace cleft {

/// Lame's moduli in MPa.
struct LinearIsotropic {
  double lambda, mu;

  LinearIsotropic(double young_modulus, double poisson_ratio)
      : lambda(young_modulus * poisson_ratio / ((1 + poisson_ratio) * (1 - 2 * poisson_ratio))),
        mu(young_modulus / (2 * (1 + poisson_ratio))) {}

  /// What a point contributes to the stiffness between two shape functions with gradients a and b:
  /// K_ij = lambda a_i b_j + mu (b_i a_j + a.b delta_ij).
  dealii::Tensor<2, 3> stiffness(const dealii::Tensor<1, 3>& a, const dealii::Tensor<1, 3>& b) const {
    dealii::Tensor<2, 3> k = lambda * outer_product(a, b) + mu * outer_product(b, a);
    const double shear = mu * (a * b);
    for (unsigned d = 0; d < 3; ++d) k[d][d] += shear;
    return k;
  }
};

}  // namespace cleft
