#include "solver/body_mesh.h"

#include <numeric>

#include "base/error.h"
#include "base/text.h"
#include "params/parameters/table.h"

namespace cleft {

PatchMesh mesh_of(const Body& body) {
  PatchMesh mesh;
  mesh.points = body.points;
  mesh.wedges = body.wedges;
  mesh.skin = body.skin;
  mesh.bottom = body.bottom;
  mesh.sides = body.sides;
  mesh.skin_above = body.skin_above;
  mesh.tension = body.tension;
  mesh.materials = body.materials, mesh.region = body.region;
  for (const Support support : body.support) mesh.on_bone.push_back(support == Support::bone);
  for (const BodyPair& p : body.pairs)
    mesh.pairs.push_back({p.left, p.right, p.normal, p.cut, p.along, p.depth});
  return mesh;
}

Release release_of(const Body& body) {
  Release release;
  release.order.resize(body.pairs.size());
  std::iota(release.order.begin(), release.order.end(), 0);
  release.released = {body.released.begin(), body.released.end()};
  release.position = body.position;
  release.times = body.times;
  release.start = -body.length / 2, release.length = body.length, release.depth = body.depth;
  return release;
}

Parameters parameters_of(const Body& body, Parameters p) {
  p.cut.length = body.length, p.cut.depth = body.depth;
  return p;
}

void check_body_case(const Body& body, const Parameters& p, const std::string& where) {
  const auto refuse = [&](const auto& member, const std::string& remedy) {
    throw InputError(where + ": " + row_of(p, member).name + " = " + text_of(p, member) +
                     ": a body (--mesh) has " + remedy);
  };
  if (p.skin.bending_stiffness > 0)
    refuse(p.skin.bending_stiffness, "no bending of its skin yet; set it to 0");
  if (p.mesh.elements == ElementOrder::quadratic) refuse(p.mesh.elements, "linear ones; set it to linear");
  if (p.skin.edges == SkinEdges::free) refuse(p.skin.edges, "held edges: the skin goes on; set it to held");
  if (p.tissue.prestress_share > 0)
    refuse(p.tissue.prestress_share, "no prestress of its tissue yet; set it to 0");
  if (p.cut.radius > 0) refuse(p.cut.radius, "the shape of its paths; leave it out");
  if (p.cut.tilt != 0) refuse(p.cut.tilt, "the tilt of its paths; leave it out");
  if (p.cut.branch > 0) refuse(p.cut.branch, "the cuts of its paths; leave it out");
  if (p.cut.count > 1) refuse(p.cut.count, "the cuts of its paths; leave it out");
  constexpr double locks = 0.49;  // from here on wedges of the formulation "displacement" do
  for (const RegionMaterial& m : body.materials)
    if (m.poisson_ratio.value_or(0) > locks && p.tissue.formulation == TissueFormulation::displacement)
      throw InputError(where + ": " + row_of(p, p.tissue.formulation).name + " = displacement: region " +
                       m.name + " of the body has poisson_ratio = " + shortest(*m.poisson_ratio) +
                       ", with which it locks; set it to mean-dilatation");
}

}  // namespace cleft
