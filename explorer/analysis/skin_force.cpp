#include "explorer/analysis/skin_force.h"

#include <cmath>

#include "base/error.h"
#include "base/text.h"
#include "haptic/surface_stiffness.h"
#include "params/parameters/springs_of_bone.h"

namespace cleft {

namespace {

/// Whether it is told so: files from before there were such patches tell nothing.
bool told_shaped(const RecordedParameters& p) {
  const auto differs = [&](const double& member) { return p.value_or(member, 0.) != 0; };
  return differs(p->cut.curvature) || differs(p->cut.curvature_rate) || differs(p->skin.curvature_u) ||
         differs(p->skin.curvature_v) || differs(p->skin.curvature_uv) || differs(p->patch.slope);
}

double of_punch(const RecordedParameters& p, double dent, double radius) {
  const auto refuse = [](const std::string& why) {
    throw InputError("column force: the force of a punch is not known of a study with " + why +
                     "; measure openings or the tension in place of it");
  };
  if (p->model == Model::finite) refuse("model = \"finite\"");
  if (p->skin.initial_stress_stiffness) refuse("skin.initial_stress_stiffness = true");
  if (p->skin.turning_stiffness > 0) refuse("skin.turning_stiffness > 0");
  if (p.value_or(p->skin.bending_stiffness, 0.) > 0) refuse("skin.bending_stiffness above 0");
  if (told_shaped(p)) refuse("a patch that is bent or slopes");
  Parameters known = *p;
  if (known.patch.bottom == PatchBottom::bone) known.foundation.stiffness = springs_of_bone(known);
  const auto layer = skin_layer(known);
  if (!layer)
    refuse("no springs below it, or whose files do not tell skin, tissue, foundation and patch.height");
  return dent * punch_stiffness(*layer, radius);
}

double of_tension(const RecordedParameters& p) {
  const auto refuse = [](const std::string& why) {
    throw InputError("column tension: the tension across the cut is not known of a study with " + why +
                     "; measure openings or the force of a punch in place of it");
  };
  if (p->skin.edges == SkinEdges::free) refuse("skin.edges = \"free\"");
  if (p.value_or(p->cut.radius, 0.) != 0) refuse("cut.radius: it differs along the cut");
  const double tension =
      p->skin.prestress.vv * (p->skin.thickness + p.value_or(p->tissue.prestress_share, 0.) * p->cut.depth);
  if (!std::isfinite(tension)) refuse("no skin.prestress_v, skin.thickness or cut.depth in its files");
  return tension;
}

}  // namespace

std::string SkinForce::text() const {
  return kind == Kind::tension ? "tension" : "force(" + shortest(dent) + ", " + shortest(radius) + ")";
}

double SkinForce::of(const RecordedParameters& parameters) const {
  return kind == Kind::tension ? of_tension(parameters) : of_punch(parameters, dent, radius);
}

}  // namespace cleft
