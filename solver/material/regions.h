// The regions of the patch and their materials.
#pragma once

#include <vector>

#include "base/vec3.h"
#include "params/parameters/parameters.h"
#include "solver/material/skin_material.h"
#include "solver/material/tissue_material.h"

namespace cleft {

/// A region of cells (tissue) or of triangles (skin), and its material in a case.
template <class Material>
struct Region {
  bool (*holds)(const Parameters&, const Vec3& centroid);  ///< whether an element belongs to it
  Material (*material)(const Parameters&);
};

/// All regions. The first row contains all elements; a later row takes its elements from the rows before it.
const std::vector<Region<TissueMaterial>>& tissue_regions();
const std::vector<Region<SkinMaterial>>& skin_regions();

/// The row of the element with this centroid.
template <class Material>
unsigned region_at(const std::vector<Region<Material>>& regions, const Parameters& parameters,
                   const Vec3& centroid) {
  unsigned row = static_cast<unsigned>(regions.size()) - 1;
  while (row > 0 && !regions[row].holds(parameters, centroid)) --row;
  return row;
}

/// The materials of a case, by row.
struct Materials {
  explicit Materials(const Parameters& parameters);
  std::vector<TissueMaterial> tissue;
  std::vector<SkinMaterial> skin;
};

}  // namespace cleft
