// What a region of the skin is made of.
#pragma once

#include <Eigen/Core>

namespace cleft {

/// Any linear membrane. The directions are u and v.
struct SkinMaterial {
  double thickness;            ///< mm
  Eigen::Matrix3d elasticity;  ///< MPa: stress (uu, vv, uv) of a strain (e_uu, e_vv, 2 e_uv), in plane stress
  Eigen::Matrix2d prestress;   ///< MPa, symmetric
};

}  // namespace cleft
