// A skin with isotropic elasticity in its plane.
#pragma once

#include "params/material/isotropic.h"
#include "params/parameters/parameters.h"
#include "solver/material/skin_material.h"

namespace cleft {

inline SkinMaterial isotropic_skin(const Parameters::Skin& skin) {
  const auto moduli = IsotropicSheet(skin.young_modulus, skin.poisson_ratio).elasticity();
  SkinMaterial material;
  material.thickness = skin.thickness;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) material.elasticity(i, j) = moduli[i][j];
  material.prestress << skin.prestress.uu, skin.prestress.uv, skin.prestress.uv, skin.prestress.vv;
  return material;
}

}  // namespace cleft
