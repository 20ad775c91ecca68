#include "params/stiffness.h"

#include "params/parameters/table.h"

namespace cleft {

std::string stiffness_key(Parameters p) {
  const Parameters defaults;
  if (p.model == Model::small) {
    if (!p.skin.initial_stress_stiffness) p.skin.prestress = {};
    p.skin.law = defaults.skin.law, p.skin.stiffening = defaults.skin.stiffening;
    p.skin.fibre_share = defaults.skin.fibre_share, p.skin.fibre_angle = defaults.skin.fibre_angle;
    p.skin.fibre_dispersion = defaults.skin.fibre_dispersion, p.tissue.law = defaults.tissue.law;
  }
  if (p.mesh.cut_length == 0) p.mesh.cut_length = p.cut.length;
  if (p.mesh.cut_depth == 0) p.mesh.cut_depth = p.cut.depth;
  p.cut.length = defaults.cut.length, p.cut.depth = defaults.cut.depth;
  p.cut.frames = defaults.cut.frames, p.cut.contact = defaults.cut.contact;
  std::string key;
  for (const Parameter& row : parameter_table()) key += to_text(get_parameter(p, row)) + ";";
  return key;
}

}  // namespace cleft
