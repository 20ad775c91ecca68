// St. Venant-Kirchhoff tissue: linear between Green's strain and the second Piola-Kirchhoff stress,
// S = lambda tr(E) I + 2 mu E. It softens under compression and is not for large ones.
#pragma once

#include "params/material/isotropic.h"
#include "solver/material/finite_tissue.h"

namespace cleft {

struct StVenantKirchhoffTissue {
  Isotropic moduli;  ///< MPa

  static constexpr bool has_volume = false;

  VolumeEnergy volume(double) const { return {}; }

  struct State {
    const Deformation& f;
    const Isotropic& moduli;
    double energy;
    Eigen::Matrix3d left;                // F F^T
    Eigen::Matrix<double, 3, 6> pulled;  // S G

    Eigen::Vector3d force(int a) const { return f.gradient * pulled.col(a); }

    PointTangent tangent() const { return {.carried = moduli.lame, .crossed_carried = moduli.shear}; }

    Eigen::Matrix3d rest(int a, int b) const {
      Eigen::Matrix3d k = moduli.shear * f.reference.col(a).dot(f.reference.col(b)) * left;
      k.diagonal().array() += f.reference.col(a).dot(pulled.col(b));
      return k;
    }
  };

  State at(const Deformation& f) const {
    const Eigen::Matrix3d strain = (f.gradient.transpose() * f.gradient - Eigen::Matrix3d::Identity()) / 2;
    const Eigen::Matrix3d stress =
        moduli.lame * strain.trace() * Eigen::Matrix3d::Identity() + 2 * moduli.shear * strain;
    return {f, moduli, stress.cwiseProduct(strain).sum() / 2, f.gradient * f.gradient.transpose(),
            stress * f.reference};
  }
};

}  // namespace cleft
