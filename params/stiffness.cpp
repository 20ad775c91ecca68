#include "params/stiffness.h"

#include "params/parameters/table.h"

namespace cleft {

std::string stiffness_key(Parameters p) {
  if (!p.skin.initial_stress_stiffness) p.skin.prestress = {};
  if (p.mesh.cut_length == 0) p.mesh.cut_length = p.cut.length;
  if (p.mesh.cut_depth == 0) p.mesh.cut_depth = p.cut.depth;
  const Parameters defaults;
  p.cut.length = defaults.cut.length, p.cut.depth = defaults.cut.depth;
  p.cut.frames = defaults.cut.frames, p.cut.contact = defaults.cut.contact;
  std::string key;
  for (const Parameter& row : parameter_table()) key += to_text(get_parameter(p, row)) + ";";
  return key;
}

}  // namespace cleft
