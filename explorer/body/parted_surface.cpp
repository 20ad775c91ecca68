#include "explorer/body/parted_surface.h"

#include <algorithm>
#include <set>
#include <utility>

#include "explorer/body/body_lips.h"

namespace cleft {

namespace {
constexpr double rounding = 1e-9;  // mm
}  // namespace

PartedSurface::PartedSurface(SurfaceMesh mesh, const std::vector<bool>& closed) : index_(std::move(mesh)) {
  const auto& triangles = index_.surface().triangles;
  std::map<std::pair<int, int>, int> at;
  next_.resize(triangles.size(), {-1, -1, -1});
  for (int t = 0; t < static_cast<int>(triangles.size()); ++t)
    for (int i = 0; i < 3; ++i) {
      const int a = triangles[t][i], b = triangles[t][(i + 1) % 3];
      at_node_[a] = t;
      if (!closed.empty() && closed[a] && closed[b]) continue;
      if (const auto other = at.find({b, a}); other != at.end()) {
        next_[t][i] = other->second / 3;
        next_[other->second / 3][other->second % 3] = t;
      }
      at[{a, b}] = 3 * t + i;
    }
}

SurfacePlace PartedSurface::nearest_from(int triangle, const Vec3& x) const {
  SurfacePlace best = index_.nearest_on(triangle, x);
  std::vector<int> open{triangle};
  std::set<int> seen{triangle};
  while (!open.empty()) {
    const int at = open.back();
    open.pop_back();
    for (const int t : next_[at]) {
      if (t < 0 || seen.contains(t)) continue;
      const SurfacePlace there = index_.nearest_on(t, x);
      const double apart = norm(there.position - x), least = norm(best.position - x);
      if (apart > least + rounding) continue;  // triangles around a node share it
      seen.insert(t), open.push_back(t);
      if (apart < least) best = there;
    }
  }
  return best;
}

int PartedSurface::triangle_at(int node) const {
  const auto found = at_node_.find(node);
  return found == at_node_.end() ? -1 : found->second;
}

SurfaceMesh walls_of(const Body& body) {
  const std::vector<int> root = first_at_place(body);
  std::map<std::array<int, 4>, std::vector<std::array<int, 4>>> at_place;  // faces, outward, cyclic
  for (const auto& w : body.wedges)
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3;
      const std::array<int, 4> face = {w[i], w[j], w[3 + j], w[3 + i]};
      std::array<int, 4> key;
      std::transform(face.begin(), face.end(), key.begin(), [&](int n) { return root[n]; });
      std::sort(key.begin(), key.end());
      at_place[key].push_back(face);
    }
  SurfaceMesh walls;
  walls.points = body.points;
  const auto sorted = [](std::array<int, 4> face) { return std::sort(face.begin(), face.end()), face; };
  for (const auto& [key, faces] : at_place) {
    if (faces.size() != 2 || sorted(faces[0]) == sorted(faces[1])) continue;  // at the surface, or within
    for (const auto& [a, b, c, d] : faces) {
      walls.triangles.push_back({a, b, c});
      walls.triangles.push_back({a, c, d});
    }
  }
  return walls;
}

}  // namespace cleft
