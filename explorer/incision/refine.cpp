#include "explorer/incision/refine.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

namespace cleft {

namespace {

/// The longest edge; of equally long ones always the same, whichever triangle is asked.
int longest_edge(const CutMesh& mesh, int t) {
  const auto rank = [&](int i) {
    const int a = mesh.triangle(t).vertex[i], b = mesh.triangle(t).vertex[(i + 1) % 3];
    // Both triangles must compute the same length to the last bit: order the ends.
    const Vec3 d = mesh.position(std::max(a, b)) - mesh.position(std::min(a, b));
    return std::tuple(squared_norm(d), std::min(a, b), std::max(a, b));
  };
  int best = 0;
  for (int i = 1; i < 3; ++i)
    if (rank(i) > rank(best)) best = i;
  return best;
}

double edge_length(const CutMesh& mesh, int t, int i) {
  return norm(mesh.position(mesh.triangle(t).vertex[(i + 1) % 3]) -
              mesh.position(mesh.triangle(t).vertex[i]));
}

bool is_skin(const CutMesh& mesh, int t) { return t >= 0 && mesh.triangle(t).region == Region::skin; }

/// Splits the first edge on the way from t along ever longer edges that is the longest of both its triangles
/// (of walls, lips and the boundary, of the one). False where that edge is not manifold.
bool split_on_the_way(CutMesh& mesh, int t, int parted[2]) {
  int edge = longest_edge(mesh, t), neighbor = mesh.triangle(t).neighbor[edge];
  while (is_skin(mesh, neighbor) && mesh.triangle(neighbor).neighbor[longest_edge(mesh, neighbor)] != t) {
    t = neighbor;
    edge = longest_edge(mesh, t);
    neighbor = mesh.triangle(t).neighbor[edge];
  }
  if (neighbor == CutMesh::non_manifold) return false;
  const int a = mesh.triangle(t).vertex[edge], b = mesh.triangle(t).vertex[(edge + 1) % 3];
  mesh.split_edge(t, edge, 0.5 * (mesh.position(std::min(a, b)) + mesh.position(std::max(a, b))));
  parted[0] = t, parted[1] = neighbor;
  return true;
}

}  // namespace

void refine_along(CutMesh& mesh, const ScalpelPath& path, double height, double max_edge, double band) {
  std::vector<Vec3> line;
  for (int i = 0; i <= 128; ++i) {
    const PathFrame frame = path.at(path.length() * i / 128);
    line.push_back(frame.position + height * frame.outward);
  }
  Vec3 low = line[0], high = low;
  for (const Vec3& p : line)
    for (int k = 0; k < 3; ++k) low[k] = std::min(low[k], p[k]), high[k] = std::max(high[k], p[k]);
  const auto distance_to_line = [&](const Vec3& x) {
    double least = squared_norm(x - line[0]);
    for (const Vec3& p : line) least = std::min(least, squared_norm(x - p));
    return std::sqrt(least);
  };
  const auto too_long = [&](int t) {
    const auto& corners = mesh.triangle(t).vertex;
    const double longest = edge_length(mesh, t, longest_edge(mesh, t));
    if (longest <= max_edge) return false;
    const Vec3 middle =
        1. / 3 * (mesh.position(corners[0]) + mesh.position(corners[1]) + mesh.position(corners[2]));
    double outside = 0;  // of the path's box: a cheap lower bound of the distance
    for (int k = 0; k < 3; ++k) outside = std::max({outside, low[k] - middle[k], middle[k] - high[k]});
    const auto limit = [&](double distance) {
      return max_edge * (1 + 3 * std::max(0.0, (distance - longest / 2) / band - 1));
    };
    return longest > limit(outside) && longest > limit(distance_to_line(middle));
  };

  std::vector<int> work;
  for (int t = 0; t < static_cast<int>(mesh.triangles().size()); ++t)
    if (is_skin(mesh, t) && too_long(t)) work.push_back(t);
  while (!work.empty()) {
    const int t = work.back();
    if (!too_long(t)) {
      work.pop_back();
      continue;
    }
    const int first_new = static_cast<int>(mesh.triangles().size());
    int parted[2];
    if (!split_on_the_way(mesh, t, parted)) {  // leave it as it is
      work.pop_back();
      continue;
    }
    for (const int other : parted)
      if (other != t && is_skin(mesh, other)) work.push_back(other);
    for (int n = first_new; n < static_cast<int>(mesh.triangles().size()); ++n)
      if (is_skin(mesh, n)) work.push_back(n);
  }
}

double longest_edge_length(const CutMesh& mesh, int t) { return edge_length(mesh, t, longest_edge(mesh, t)); }

bool bisect(CutMesh& mesh, int t) {
  for (int parted[2]; split_on_the_way(mesh, t, parted);)
    if (parted[0] == t || parted[1] == t) return true;
  return false;
}

}  // namespace cleft
