#include "solver/material/regions.h"

#include <numbers>

#include "solver/material/fung_skin.h"
#include "solver/material/isotropic_skin.h"
#include "solver/material/linear_isotropic.h"
#include "solver/material/neo_hookean_skin.h"
#include "solver/material/neo_hookean_tissue.h"
#include "solver/material/st_venant_kirchhoff_skin.h"
#include "solver/material/st_venant_kirchhoff_tissue.h"

namespace cleft {

namespace {

bool everywhere(const Parameters&, const Vec3&) { return true; }

Isotropic tissue_moduli(const Parameters& p) { return {p.tissue.young_modulus, p.tissue.poisson_ratio}; }

FiniteTissue finite_tissue(const Parameters& p) {
  if (p.tissue.law == TissueLaw::st_venant_kirchhoff) return StVenantKirchhoffTissue{tissue_moduli(p)};
  return NeoHookeanTissue{tissue_moduli(p)};
}

FiniteSkin finite_skin(const Parameters& p) {
  const SkinMaterial linear = isotropic_skin(p.skin);
  const auto [uu, vv, uv] = p.skin.prestress;
  const Eigen::Vector3d prestress(uu, vv, uv);
  const double shear = Isotropic(p.skin.young_modulus, p.skin.poisson_ratio).shear;
  switch (p.skin.law) {
    case SkinLaw::neo_hookean:
      return {linear.thickness, NeoHookeanSkin{prestress, shear, p.skin.poisson_ratio}};
    case SkinLaw::fung:
      return {linear.thickness, FungSkin(prestress, linear.elasticity, p.skin.stiffening,
                                         {p.skin.fibre_share, p.skin.fibre_angle * std::numbers::pi / 180,
                                          p.skin.fibre_dispersion})};
    default:
      return {linear.thickness, StVenantKirchhoffSkin{prestress, linear.elasticity}};
  }
}

/// Calls visit(row, parameters) for each row of tissue, or for each region of a body.
template <class Visit>
void each_tissue(const Parameters& parameters, const std::vector<RegionMaterial>& own, const Visit& visit) {
  if (own.empty())
    for (const auto& row : tissue_regions()) visit(row, parameters);
  for (const RegionMaterial& region : own) {
    Parameters p = parameters;
    p.tissue = region.tissue_of(p);
    visit(tissue_regions().front(), p);
  }
}

}  // namespace

const std::vector<TissueRegion>& tissue_regions() {
  static const std::vector<TissueRegion> regions = {
      {everywhere, [](const Parameters& p) -> TissueMaterial { return LinearIsotropic{tissue_moduli(p)}; },
       finite_tissue},
  };
  return regions;
}

const std::vector<SkinRegion>& skin_regions() {
  static const std::vector<SkinRegion> regions = {
      {everywhere, [](const Parameters& p) { return isotropic_skin(p.skin); }, finite_skin},
  };
  return regions;
}

Materials::Materials(const Parameters& parameters, const std::vector<RegionMaterial>& own) {
  each_tissue(parameters, own,
              [&](const TissueRegion& row, const Parameters& p) { tissue.push_back(row.material(p)); });
  for (const auto& region : skin_regions()) skin.push_back(region.material(parameters));
}

FiniteMaterials::FiniteMaterials(const Parameters& parameters, const std::vector<RegionMaterial>& own) {
  each_tissue(parameters, own,
              [&](const TissueRegion& row, const Parameters& p) { tissue.push_back(row.finite(p)); });
  for (const auto& region : skin_regions()) skin.push_back(region.finite(parameters));
}

}  // namespace cleft
