#include "solver/material/regions.h"

#include "solver/material/isotropic_skin.h"
#include "solver/material/linear_isotropic.h"

namespace cleft {

namespace {

bool everywhere(const Parameters&, const Vec3&) { return true; }

}  // namespace

const std::vector<Region<TissueMaterial>>& tissue_regions() {
  static const std::vector<Region<TissueMaterial>> regions = {
      {everywhere,
       [](const Parameters& p) -> TissueMaterial {
         return LinearIsotropic{{p.tissue.young_modulus, p.tissue.poisson_ratio}};
       }},
  };
  return regions;
}

const std::vector<Region<SkinMaterial>>& skin_regions() {
  static const std::vector<Region<SkinMaterial>> regions = {
      {everywhere, [](const Parameters& p) { return isotropic_skin(p.skin); }},
  };
  return regions;
}

Materials::Materials(const Parameters& parameters) {
  for (const auto& region : tissue_regions()) tissue.push_back(region.material(parameters));
  for (const auto& region : skin_regions()) skin.push_back(region.material(parameters));
}

}  // namespace cleft
