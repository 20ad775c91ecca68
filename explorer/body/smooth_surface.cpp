#include "explorer/body/smooth_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace cleft {

namespace {

constexpr double least_agreement = 0.866;  // cosine of 30 degrees

Vec3 normal_of(const SurfaceMesh& mesh, const std::array<int, 3>& t) {
  return cross(mesh.points[t[1]] - mesh.points[t[0]], mesh.points[t[2]] - mesh.points[t[0]]);
}

/// With weights that are exact where a point and its neighbours lie on a sphere (Max 1999).
std::vector<Vec3> smooth_normals(const SurfaceMesh& mesh) {
  std::vector<Vec3> normals(mesh.points.size());
  for (const auto& t : mesh.triangles)
    for (int i = 0; i < 3; ++i) {
      const Vec3 a = mesh.points[t[(i + 1) % 3]] - mesh.points[t[i]],
                 b = mesh.points[t[(i + 2) % 3]] - mesh.points[t[i]];
      const double sides = squared_norm(a) * squared_norm(b);
      if (sides > 0) normals[t[i]] += 1 / sides * cross(a, b);
    }
  for (Vec3& n : normals)
    if (squared_norm(n) > 0) n = normalized(n);
  std::vector<bool> is_feature(normals.size());
  for (const auto& t : mesh.triangles) {
    const Vec3 own = normal_of(mesh, t);
    for (const int p : t)
      if (dot(own, normals[p]) < least_agreement * norm(own)) is_feature[p] = true;
  }
  for (std::size_t p = 0; p < normals.size(); ++p)
    if (is_feature[p]) normals[p] = {};
  return normals;
}

/// The triangles of a mesh that reach into the box of some places, with all its points.
SurfaceMesh part_of(const SurfaceMesh& mesh, const std::vector<Vec3>& places) {
  Vec3 least = places.front(), most = least;
  for (const Vec3& p : places)
    for (int i = 0; i < 3; ++i) least[i] = std::min(least[i], p[i]), most[i] = std::max(most[i], p[i]);
  SurfaceMesh part{mesh.points, {}};
  for (const auto& t : mesh.triangles) {
    bool reaches = true;
    for (int i = 0; i < 3; ++i) {
      const auto [low, high] =
          std::minmax({mesh.points[t[0]][i], mesh.points[t[1]][i], mesh.points[t[2]][i]});
      reaches = reaches && low <= most[i] && high >= least[i];
    }
    if (reaches) part.triangles.push_back(t);
  }
  return part;
}

}  // namespace

SmoothSurface::SmoothSurface(const SurfaceMesh& mesh, const std::vector<Vec3>& places)
    : normals_(smooth_normals(mesh)), part_(part_of(mesh, places)) {}

Vec3 SmoothSurface::nearest(const Vec3& x) const {
  const SurfacePlace place = part_.nearest(x);
  const SurfaceMesh& mesh = part_.surface();
  const auto& corners = mesh.triangles[place.triangle];
  const auto& w = place.weights;
  const auto at = [&](int i) { return mesh.points[corners[i]]; };
  // The control points next to corner i on its edge to corner j.
  const auto beside = [&](int i, int j) {
    const Vec3& normal = normals_[corners[i]];
    return 1. / 3 * (2 * at(i) + at(j) - dot(at(j) - at(i), normal) * normal);
  };
  Vec3 edges, result;
  for (int i = 0; i < 3; ++i) {
    result += w[i] * w[i] * w[i] * at(i);
    for (const int j : {(i + 1) % 3, (i + 2) % 3}) {
      const Vec3 control = beside(i, j);
      edges += 1. / 6 * control;
      result += 3 * w[i] * w[i] * w[j] * control;
    }
  }
  const Vec3 middle = 1.5 * edges - 0.5 / 3 * (at(0) + at(1) + at(2));
  return result + 6 * w[0] * w[1] * w[2] * middle;
}

}  // namespace cleft
