// Layers of different tissue below a surface: dermis, fat, muscle.
#pragma once

#include <vector>

#include "explorer/body/extrusion.h"
#include "params/region_materials.h"

namespace cleft {

struct TissueLayer {
  RegionMaterial material;
  double to_depth;  ///< mm below the skin; infinite: all that is left
};

/// From the skin down. Throws InputError that names the section if its depths do not increase, or it is of
/// one's own mesh.
std::vector<TissueLayer> layers_of(const RegionFile& file);

/// With a layer of nodes at each depth at which the tissue changes: one that is below the cut and near moves
/// there, else one is added; but no wedges below a twentieth of `size` are made for it. Throws InputError if
/// a layer ends below the thickness.
Layers divided(Layers layers, const std::vector<TissueLayer>& tissue, double size);

/// The number of the tissue between nodes of the layers k and k + 1.
int tissue_between(const Layers& layers, const std::vector<TissueLayer>& tissue, int k);

}  // namespace cleft
