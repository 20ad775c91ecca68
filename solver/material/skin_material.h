// The material of a region of the skin.
#pragma once

#include <Eigen/Core>

namespace cleft {

/// A linear membrane with the directions u and v.
struct SkinMaterial {
  double thickness;            ///< mm
  Eigen::Matrix3d elasticity;  ///< MPa: stress (uu, vv, uv) of a strain (e_uu, e_vv, 2 e_uv), in plane stress
  Eigen::Matrix2d prestress;   ///< MPa, symmetric
};

}  // namespace cleft
