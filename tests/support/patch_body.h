// A patch as a body: bent around something, with all that a body file holds.
#pragma once

#include <functional>

#include "solver/body/body.h"
#include "solver/patch_mesh.h"

namespace cleft {

/// A place of the patch in space, and the unit vectors of u, v and w there.
struct BentPlace {
  Vec3 position;
  std::array<Vec3, 3> axes;
};

/// The whole patch of a case, whose cuts open as they would in it.
inline Body body_of_patch(const Parameters& parameters, const std::function<BentPlace(const Vec3&)>& bend) {
  const PatchMesh mesh = make_patch_mesh(parameters);
  const Release release = make_release(mesh, parameters);
  Body body;
  for (const Vec3& p : mesh.points) {
    const BentPlace at = bend(p);
    body.points.push_back(at.position), body.frames.push_back(at.axes);
  }
  body.canonical = mesh.points;
  body.wedges = mesh.wedges, body.skin = mesh.skin, body.bottom = mesh.bottom, body.sides = mesh.sides;
  body.support.assign(body.bottom.size(), Support::springs);
  body.skin_above = mesh.skin_above;
  for (const auto& t : body.skin) {
    const Vec3 middle = 1. / 3 * (mesh.points[t[0]] + mesh.points[t[1]] + mesh.points[t[2]]);
    body.tension.push_back(bend(middle).axes[0]);
  }
  for (const int number : release.order) {
    const NodePair& p = mesh.pairs[number];
    const std::array<Vec3, 3>& axes = body.frames[p.left];
    const Vec3 normal = p.normal.x * axes[0] + p.normal.y * axes[1] + p.normal.z * axes[2];
    body.pairs.push_back({p.left, p.right, p.incision, p.along, p.depth, normal});
  }
  body.released = {release.released.begin(), release.released.end()};
  body.position = release.position, body.times = release.times;
  body.length = release.length, body.depth = release.depth;
  check_body(body, "the body of a patch");
  return body;
}

inline BentPlace flat(const Vec3& p) { return {p, {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}}; }

/// Around a cylinder whose axis is along u.
inline std::function<BentPlace(const Vec3&)> around_cylinder(double radius) {
  return [radius](const Vec3& p) -> BentPlace {
    const double angle = p.y / radius, s = std::sin(angle), c = std::cos(angle);
    return {{p.x, (radius + p.z) * s, (radius + p.z) * c - radius},
            {Vec3{1, 0, 0}, Vec3{0, c, -s}, Vec3{0, s, c}}};
  };
}

}  // namespace cleft
