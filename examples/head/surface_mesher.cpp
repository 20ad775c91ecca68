#include "examples/head/surface_mesher.h"

#include <algorithm>
#include <array>
#include <queue>
#include <stdexcept>

namespace cleft::head {
namespace {

/// A triangle mesh under change: every vertex knows its triangles.
class Remesher {
 public:
  Remesher(TriangleMesh mesh, const MeshingTask& task) : task_(task), x_(std::move(mesh.points)) {
    star_.resize(x_.size());
    for (const auto& t : mesh.triangles) {
      for (int v : t) star_[v].push_back(static_cast<int>(triangles_.size()));
      triangles_.push_back(t);
    }
    alive_ = static_cast<int>(triangles_.size());
    wanted_.resize(x_.size());
    measure_wanted_lengths();
  }

  /// Collapses edges, shortest against the wanted length first, until `count` triangles are left.
  void collapse_to(int count) {
    struct Candidate {
      double length;
      int a, b;
      bool operator<(const Candidate& other) const { return length > other.length; }
    };
    std::priority_queue<Candidate> queue;
    const auto push = [&](int a, int b) { queue.push({relative_length(a, b), a, b}); };
    for (int a = 0; a < static_cast<int>(x_.size()); ++a)
      for (int b : ring(a))
        if (a < b) push(a, b);
    while (alive_ > count) {
      if (queue.empty()) throw std::runtime_error("the head cannot be meshed with so few triangles");
      const auto [length, a, b] = queue.top();
      queue.pop();
      if (star_[a].empty() || star_[b].empty() || length != relative_length(a, b)) continue;
      if (!shares_triangle(a, b)) continue;
      if (!collapse(a, b, length) && !collapse(b, a, length)) continue;
      const int kept = star_[a].empty() ? b : a;
      for (int v : ring(kept)) push(kept, v);
    }
  }

  /// Flips every edge whose opposite angles add up to more than half a turn (Delaunay's criterion).
  void flip() {
    for (int a = 0; a < static_cast<int>(x_.size()); ++a)
      for (int b : ring(a))
        if (a < b) flip_edge(a, b);
  }

  /// Moves every vertex to the weighted centre of its triangles, and back onto the surface.
  void smooth() {
    std::vector<Vec3> moved = x_;
    for (int a = 0; a < static_cast<int>(x_.size()); ++a) {
      if (star_[a].empty()) continue;
      Vec3 sum;
      double weight = 0;
      for (int t : star_[a]) {
        const auto& [i, j, k] = triangles_[t];
        const double size = wanted_[i] + wanted_[j] + wanted_[k];
        const double w = norm(area_vector(triangles_[t])) / (size * size);
        sum += w / 3 * (x_[i] + x_[j] + x_[k]);
        weight += w;
      }
      moved[a] = task_.project(lerp(x_[a], 1 / weight * sum, 0.8));
    }
    // A step that would turn a triangle over is not taken.
    for (int a = 0; a < static_cast<int>(x_.size()); ++a) {
      const Vec3 old = x_[a];
      std::vector<Vec3> before;
      for (int t : star_[a]) before.push_back(area_vector(triangles_[t]));
      x_[a] = moved[a];
      for (std::size_t i = 0; i < before.size(); ++i) {
        const Vec3 after = area_vector(triangles_[star_[a][i]]);
        if (dot(after, before[i]) < 0.4 * norm(after) * norm(before[i])) x_[a] = old;
      }
    }
    measure_wanted_lengths();
  }

  TriangleMesh take() const {
    TriangleMesh mesh;
    std::vector<int> number(x_.size(), -1);
    for (std::size_t v = 0; v < x_.size(); ++v)
      if (!star_[v].empty()) {
        number[v] = static_cast<int>(mesh.points.size());
        mesh.points.push_back(x_[v]);
      }
    for (const auto& [a, b, c] : triangles_)
      if (a >= 0) mesh.triangles.push_back({number[a], number[b], number[c]});
    return mesh;
  }

 private:
  using Triangle = std::array<int, 3>;

  void measure_wanted_lengths() {
    for (std::size_t v = 0; v < x_.size(); ++v)
      if (!star_[v].empty()) wanted_[v] = task_.edge_length(x_[v]);
  }

  double relative_length(int a, int b) const { return 2 * norm(x_[a] - x_[b]) / (wanted_[a] + wanted_[b]); }

  Vec3 area_vector(const Triangle& t) const { return cross(x_[t[1]] - x_[t[0]], x_[t[2]] - x_[t[0]]); }

  static bool has(const Triangle& t, int v) { return t[0] == v || t[1] == v || t[2] == v; }

  bool shares_triangle(int a, int b) const {
    return std::any_of(star_[a].begin(), star_[a].end(), [&](int t) { return has(triangles_[t], b); });
  }

  std::vector<int> ring(int a) const {
    std::vector<int> neighbours;
    for (int t : star_[a])
      for (int v : triangles_[t])
        if (v != a) neighbours.push_back(v);
    std::sort(neighbours.begin(), neighbours.end());
    neighbours.erase(std::unique(neighbours.begin(), neighbours.end()), neighbours.end());
    return neighbours;
  }

  /// Moves a onto b. False where that would change the topology, turn a triangle over or make it a needle.
  bool collapse(int a, int b, double length) {
    const std::vector<int> ring_a = ring(a), ring_b = ring(b);
    std::vector<int> common;
    std::set_intersection(ring_a.begin(), ring_a.end(), ring_b.begin(), ring_b.end(),
                          std::back_inserter(common));
    if (common.size() != 2 || ring_a.size() + ring_b.size() - 4 > 9) return false;
    for (int v : common)
      if (star_[v].size() <= 3) return false;
    for (int t : star_[a]) {
      if (has(triangles_[t], b)) continue;
      Triangle changed = triangles_[t];
      std::replace(changed.begin(), changed.end(), a, b);
      const Vec3 before = area_vector(triangles_[t]), after = area_vector(changed);
      if (dot(before, after) < 0.5 * norm(before) * norm(after)) return false;
    }
    for (int v : ring_a)
      if (v != b && relative_length(v, b) > 2.2 * std::max(length, 0.5 * mean_length())) return false;
    for (int t : std::vector<int>(star_[a])) {
      if (has(triangles_[t], b)) {
        for (int v : triangles_[t]) std::erase(star_[v], t);
        triangles_[t] = {-1, -1, -1};
        --alive_;
      } else {
        std::replace(triangles_[t].begin(), triangles_[t].end(), a, b);
        star_[b].push_back(t);
      }
    }
    star_[a].clear();
    return true;
  }

  /// The relative edge length that the mesh would have if all its edges were equally long.
  double mean_length() {
    if (area_ == 0)
      for (const Triangle& t : triangles_) {
        const double size = (wanted_[t[0]] + wanted_[t[1]] + wanted_[t[2]]) / 3;
        area_ += norm(area_vector(t)) / 2 / (size * size);
      }
    return std::sqrt(area_ / alive_ * 4 / std::sqrt(3));
  }

  void flip_edge(int a, int b) {
    int sides[2], count = 0;
    for (int t : star_[a])
      if (has(triangles_[t], b) && count < 2) sides[count++] = t;
    if (count < 2) return;
    const auto opposite = [&](int t) {
      return triangles_[t][0] + triangles_[t][1] + triangles_[t][2] - a - b;
    };
    const auto follows = [&](int t) {  // a then b in the triangle's order
      const Triangle& v = triangles_[t];
      return (v[0] == a && v[1] == b) || (v[1] == a && v[2] == b) || (v[2] == a && v[0] == b);
    };
    if (!follows(sides[0])) std::swap(sides[0], sides[1]);
    const int c = opposite(sides[0]), d = opposite(sides[1]);
    const auto angle = [&](int at) {
      const Vec3 p = x_[a] - x_[at], q = x_[b] - x_[at];
      return std::atan2(norm(cross(p, q)), dot(p, q));
    };
    if (angle(c) + angle(d) < M_PI + 1e-6 || shares_triangle(c, d)) return;
    if (star_[a].size() <= 4 || star_[b].size() <= 4) return;
    const Triangle first{c, a, d}, second{d, b, c};
    const Vec3 old = area_vector(triangles_[sides[0]]) + area_vector(triangles_[sides[1]]);
    for (const Triangle& t : {first, second})
      if (dot(area_vector(t), old) < 0.6 * norm(area_vector(t)) * norm(old)) return;
    triangles_[sides[0]] = first, triangles_[sides[1]] = second;
    std::erase(star_[b], sides[0]), std::erase(star_[a], sides[1]);
    star_[d].push_back(sides[0]), star_[c].push_back(sides[1]);
  }

  const MeshingTask& task_;
  std::vector<Vec3> x_;
  std::vector<Triangle> triangles_;  ///< -1 where removed
  std::vector<std::vector<int>> star_;
  std::vector<double> wanted_;
  int alive_ = 0;
  double area_ = 0;
};

}  // namespace

TriangleMesh mesh_surface(const MeshingTask& task) {
  Remesher remesher(march(task.distance, task.box, task.spacing), task);
  remesher.collapse_to(2 * task.triangles);
  for (int round = 0; round < 2; ++round) remesher.flip(), remesher.smooth();
  remesher.collapse_to(task.triangles);
  for (int round = 0; round < 8; ++round) remesher.flip(), remesher.smooth();
  remesher.flip();
  return remesher.take();
}

TriangleMesh mesh_head(int triangles) {
  return mesh_surface({distance, project, relative_edge_length, bounds(), 2.6, triangles / 2 * 2});
}

}  // namespace cleft::head
