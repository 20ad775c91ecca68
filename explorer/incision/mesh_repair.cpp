#include "explorer/incision/mesh_repair.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace cleft {

namespace {

struct Side {
  int low, high, triangle;
  bool forward;
};

/// All triangles' edges, those between the same points next to each other.
std::vector<Side> sides_of(const SurfaceMesh& mesh) {
  std::vector<Side> sides;
  sides.reserve(3 * mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (int i = 0; i < 3; ++i) {
      const int a = mesh.triangles[t][i], b = mesh.triangles[t][(i + 1) % 3];
      sides.push_back({std::min(a, b), std::max(a, b), static_cast<int>(t), a < b});
    }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
  });
  return sides;
}

template <class F>
void for_each_edge(const std::vector<Side>& sides, const F& f) {
  for (std::size_t i = 0; i < sides.size();) {
    std::size_t end = i + 1;
    while (end < sides.size() && sides[end].low == sides[i].low && sides[end].high == sides[i].high) ++end;
    f(i, end);
    i = end;
  }
}

SurfaceMesh without_duplicates(const SurfaceMesh& mesh, MeshReport& report) {
  std::vector<std::pair<std::array<int, 3>, std::size_t>> keys;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    auto key = mesh.triangles[t];
    std::sort(key.begin(), key.end());
    keys.push_back({key, t});
  }
  std::sort(keys.begin(), keys.end());
  std::vector<bool> twice(mesh.triangles.size());
  for (std::size_t i = 1; i < keys.size(); ++i)
    if (keys[i].first == keys[i - 1].first) twice[keys[i].second] = true;
  SurfaceMesh result{mesh.points, {}, mesh.colors, mesh.note};
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (!twice[t]) result.triangles.push_back(mesh.triangles[t]);
  report.duplicate_triangles = static_cast<int>(mesh.triangles.size() - result.triangles.size());
  return result;
}

/// A component's number for every triangle, and whether it is to be turned to agree with the first of it.
struct Orientation {
  std::vector<int> component;
  std::vector<bool> turn;
  int components = 0;
};

Orientation orientation_of(const SurfaceMesh& mesh, const std::vector<Side>& sides) {
  struct Neighbor {
    int triangle;
    bool agrees;
  };
  const std::size_t count = mesh.triangles.size();
  std::vector<std::vector<Neighbor>> neighbors(count);
  for_each_edge(sides, [&](std::size_t i, std::size_t end) {
    if (end - i != 2) return;
    const Side &a = sides[i], &b = sides[i + 1];
    neighbors[a.triangle].push_back({b.triangle, a.forward != b.forward});
    neighbors[b.triangle].push_back({a.triangle, a.forward != b.forward});
  });
  Orientation result{std::vector<int>(count, -1), std::vector<bool>(count), 0};
  for (std::size_t first = 0; first < count; ++first) {
    if (result.component[first] >= 0) continue;
    std::vector<int> members{static_cast<int>(first)};
    result.component[first] = result.components;
    std::size_t turned = 0;
    for (std::size_t k = 0; k < members.size(); ++k) {
      const int t = members[k];
      turned += result.turn[t];
      for (const auto& [other, agrees] : neighbors[t]) {
        if (result.component[other] >= 0) continue;
        result.component[other] = result.components;
        result.turn[other] = result.turn[t] != !agrees;
        members.push_back(other);
      }
    }
    if (2 * turned > members.size())
      for (const int t : members) result.turn[t] = !result.turn[t];
    ++result.components;
  }
  return result;
}

int vertices_of_many_fans(const SurfaceMesh& mesh) {
  // Around a vertex, the corners that share an edge with it belong together.
  struct Corner {
    int vertex, next, previous;
  };
  std::vector<Corner> corners;
  for (const auto& t : mesh.triangles)
    for (int i = 0; i < 3; ++i) corners.push_back({t[i], t[(i + 1) % 3], t[(i + 2) % 3]});
  std::sort(corners.begin(), corners.end(),
            [](const Corner& a, const Corner& b) { return a.vertex < b.vertex; });
  int many = 0;
  for (std::size_t i = 0; i < corners.size();) {
    std::size_t end = i + 1;
    while (end < corners.size() && corners[end].vertex == corners[i].vertex) ++end;
    std::vector<std::size_t> root(end - i);
    std::iota(root.begin(), root.end(), 0);
    const auto find = [&root](std::size_t k) {
      while (root[k] != k) k = root[k] = root[root[k]];
      return k;
    };
    std::size_t fans = end - i;
    for (std::size_t a = i; a < end; ++a)
      for (std::size_t b = a + 1; b < end; ++b) {
        const Corner &x = corners[a], &y = corners[b];
        if (x.next != y.next && x.next != y.previous && x.previous != y.next && x.previous != y.previous)
          continue;
        const std::size_t p = find(a - i), q = find(b - i);
        if (p != q) root[p] = q, --fans;
      }
    many += fans > 1;
    i = end;
  }
  return many;
}

/// Parts that share no point.
int components_of(const SurfaceMesh& mesh) {
  std::vector<int> root(mesh.points.size());
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&root](int v) {
    while (root[v] != v) v = root[v] = root[root[v]];
    return v;
  };
  std::vector<bool> used(mesh.points.size());
  for (const auto& t : mesh.triangles)
    for (const int v : t) used[v] = true, root[find(v)] = find(t[0]);
  int count = 0;
  for (std::size_t v = 0; v < root.size(); ++v) count += used[v] && root[v] == static_cast<int>(v);
  return count;
}

}  // namespace

SurfaceMesh repaired(const SurfaceMesh& mesh, MeshReport& report) {
  SurfaceMesh result = without_duplicates(mesh, report);
  const Orientation orientation = orientation_of(result, sides_of(result));
  report.turned_triangles =
      static_cast<int>(std::count(orientation.turn.begin(), orientation.turn.end(), true));
  for (std::size_t t = 0; t < result.triangles.size(); ++t)
    if (orientation.turn[t]) std::swap(result.triangles[t][1], result.triangles[t][2]);

  const std::vector<Side> sides = sides_of(result);
  std::vector<bool> closed(orientation.components, true);
  report.boundary_edges = report.non_manifold_edges = 0;
  for_each_edge(sides, [&](std::size_t i, std::size_t end) {
    const bool sound = end - i == 2 && sides[i].forward != sides[i + 1].forward;
    report.boundary_edges += end - i == 1;
    report.non_manifold_edges += end - i > 1 && !sound;
    if (!sound)
      for (std::size_t k = i; k < end; ++k) closed[orientation.component[sides[k].triangle]] = false;
  });
  std::vector<double> volume(orientation.components);
  for (std::size_t t = 0; t < result.triangles.size(); ++t) {
    const auto& [a, b, c] = result.triangles[t];
    const Vec3& near =
        result.points[result.triangles[0][0]];  // far from the origin volumes would be rounding
    volume[orientation.component[t]] +=
        dot(result.points[a] - near, cross(result.points[b] - near, result.points[c] - near));
  }
  report.inside_out_components = 0;
  for (int k = 0; k < orientation.components; ++k) report.inside_out_components += closed[k] && volume[k] < 0;
  report.components = components_of(result);
  report.non_manifold_vertices = vertices_of_many_fans(result);
  report.points = static_cast<int>(result.points.size());
  report.triangles = static_cast<int>(result.triangles.size());
  return result;
}

}  // namespace cleft
