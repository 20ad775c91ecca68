// Places where a surface passes through itself, by brute force within cells of space.
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "explorer/incision/surface_mesh.h"

namespace cleft::testing {

/// Whether segment pq passes through triangle abc, not only touching it.
inline bool pierces(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, const Vec3& c) {
  const auto volume = [](const Vec3& o, const Vec3& x, const Vec3& y, const Vec3& z) {
    return dot(cross(x - o, y - o), z - o);
  };
  constexpr double tiny = 1e-9;
  const double above = volume(a, b, c, p), below = volume(a, b, c, q);
  if (!(above * below < 0) || std::abs(above) < tiny || std::abs(below) < tiny) return false;
  const double u = volume(p, q, a, b), v = volume(p, q, b, c), w = volume(p, q, c, a);
  return (u > tiny && v > tiny && w > tiny) || (u < -tiny && v < -tiny && w < -tiny);
}

/// How many triangles are pierced by others that share no vertex with them.
inline int self_intersections(const SurfaceMesh& mesh) {
  // Triangles that share a vertex are not asked: they meet there. The others by cells of space.
  std::map<std::array<int, 3>, std::vector<int>> cells;
  const auto box_of = [&](int t) {
    std::array<std::array<int, 3>, 2> box;
    for (int k = 0; k < 3; ++k) {
      double low = 1e9, high = -1e9;
      for (const int v : mesh.triangles[t])
        low = std::min(low, mesh.points[v][k]), high = std::max(high, mesh.points[v][k]);
      box[0][k] = static_cast<int>(std::floor(low)), box[1][k] = static_cast<int>(std::floor(high));
    }
    return box;
  };
  const auto each_cell = [&](int t, const auto& use) {
    const auto [low, high] = box_of(t);
    for (int x = low[0]; x <= high[0]; ++x)
      for (int y = low[1]; y <= high[1]; ++y)
        for (int z = low[2]; z <= high[2]; ++z) use(std::array{x, y, z});
  };
  const auto count = static_cast<int>(mesh.triangles.size());
  for (int t = 0; t < count; ++t) each_cell(t, [&](const auto& cell) { cells[cell].push_back(t); });
  int found = 0;
  for (int t = 0; t < count; ++t) {
    const auto& a = mesh.triangles[t];
    bool hit = false;
    each_cell(t, [&](const auto& cell) {
      for (const int other : cells[cell]) {
        const auto& b = mesh.triangles[other];
        if (hit || std::find_first_of(a.begin(), a.end(), b.begin(), b.end()) != a.end()) continue;
        const auto at = [&](int v) { return mesh.points[v]; };
        for (int i = 0; i < 3 && !hit; ++i)
          hit = pierces(at(a[i]), at(a[(i + 1) % 3]), at(b[0]), at(b[1]), at(b[2]));
      }
    });
    found += hit;
  }
  return found;
}

}  // namespace cleft::testing
