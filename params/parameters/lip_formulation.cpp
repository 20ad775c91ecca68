#include "params/parameters/lip_formulation.h"

#include <cmath>

namespace cleft {

void settle_formulation(Parameters& p, double degrees) {
  const bool has = p.mesh.elements == ElementOrder::linear &&
                   (p.model == Model::small || p.tissue.law == TissueLaw::neo_hookean);
  if (has && std::abs(degrees) >= least_tilt) p.tissue.formulation = TissueFormulation::mean_dilatation;
}

}  // namespace cleft
