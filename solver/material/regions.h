// The regions of the patch and their materials.
#pragma once

#include <vector>

#include "base/vec3.h"
#include "params/parameters/parameters.h"
#include "params/region_material.h"
#include "solver/material/finite_skin.h"
#include "solver/material/finite_tissue.h"
#include "solver/material/skin_material.h"
#include "solver/material/tissue_material.h"

namespace cleft {

/// A region of cells (tissue) or of triangles (skin), and its material in a case: that of the small model,
/// and that of the finite one.
template <class Material, class Finite>
struct Region {
  bool (*holds)(const Parameters&, const Vec3& centroid);  ///< whether an element belongs to it
  Material (*material)(const Parameters&);
  Finite (*finite)(const Parameters&);
};
using TissueRegion = Region<TissueMaterial, FiniteTissue>;
using SkinRegion = Region<SkinMaterial, FiniteSkin>;

/// All regions. The first row contains all elements; a later row takes its elements from the rows before it.
const std::vector<TissueRegion>& tissue_regions();
const std::vector<SkinRegion>& skin_regions();

/// The row of the element with this centroid.
template <class Material, class Finite>
unsigned region_at(const std::vector<Region<Material, Finite>>& regions, const Parameters& parameters,
                   const Vec3& centroid) {
  unsigned row = static_cast<unsigned>(regions.size()) - 1;
  while (row > 0 && !regions[row].holds(parameters, centroid)) --row;
  return row;
}

/// The materials of a case, by row. Where a body has regions of its own, these stand for the rows of tissue:
/// each is the first row's material with the region's moduli.
struct Materials {
  explicit Materials(const Parameters& parameters, const std::vector<RegionMaterial>& own = {});
  std::vector<TissueMaterial> tissue;
  std::vector<SkinMaterial> skin;
};

/// Those of the finite model.
struct FiniteMaterials {
  explicit FiniteMaterials(const Parameters& parameters, const std::vector<RegionMaterial>& own = {});
  std::vector<FiniteTissue> tissue;
  std::vector<FiniteSkin> skin;
};

}  // namespace cleft
