// St. Venant-Kirchhoff skin: S = sigma_0 + D E.
#pragma once

#include "solver/material/finite_skin.h"

namespace cleft {

struct StVenantKirchhoffSkin {
  Eigen::Vector3d prestress;   ///< MPa: uu, vv, uv
  Eigen::Matrix3d elasticity;  ///< MPa: plane stress

  SkinResponse at(const Eigen::Vector3d& strain) const {
    const Eigen::Vector3d change = elasticity * strain;
    return {strain.dot(prestress + change / 2), prestress + change, elasticity};
  }
};

}  // namespace cleft
