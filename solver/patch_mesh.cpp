#include "solver/patch_mesh.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cleft {

namespace {

/// Coordinates from the first to the last stop, each stretch between stops in equal steps of at most `step`.
std::vector<double> lines(const std::vector<double>& stops, double step) {
  std::vector<double> result = {stops.front()};
  for (std::size_t i = 1; i < stops.size(); ++i) {
    const double from = stops[i - 1], length = stops[i] - from;
    const int count = static_cast<int>(std::ceil(std::abs(length) / step - 1e-9));
    for (int k = 1; k < count; ++k) result.push_back(from + length * k / count);
    result.push_back(stops[i]);
  }
  return result;
}

class PatchMesher {
 public:
  explicit PatchMesher(const Parameters& p)
      : p_(p),
        u_(lines({-p.patch.length / 2, -p.cut.length / 2, p.cut.length / 2, p.patch.length / 2},
                 p.mesh.element_size)),
        v_(lines({-p.patch.width / 2, 0, p.patch.width / 2}, p.mesh.element_size)),
        w_(lines({0, -p.cut.depth, -p.patch.height}, p.mesh.element_size)),
        plane_(static_cast<int>(v_.size()) / 2) {}

  PatchMesh mesh() {
    add_points();
    add_pairs();
    add_elements();
    add_sides();
    return std::move(mesh_);
  }

 private:
  int node(int i, int j, int k) const {
    return (k * static_cast<int>(v_.size()) + j) * static_cast<int>(u_.size()) + i;
  }

  bool is_cut(int i, int k) const { return std::abs(u_[i]) < p_.cut.length / 2 && w_[k] > -p_.cut.depth; }

  void add_points() {
    for (const double w : w_)
      for (const double v : v_)
        for (const double u : u_) mesh_.points.push_back({u, v, w});
    right_of_.resize(mesh_.points.size());
    for (std::size_t n = 0; n < right_of_.size(); ++n) {
      right_of_[n] = static_cast<int>(n);
      mesh_.skin_above.push_back(static_cast<int>(n % (u_.size() * v_.size())));
    }
  }

  /// The right node is the duplicate.
  void add_pairs() {
    mesh_.lines_along.emplace_back();
    for (const double u : u_)
      if (std::abs(u) <= p_.cut.length / 2) mesh_.lines_along[0].push_back(u);
    for (const double w : w_)
      if (w >= -p_.cut.depth) mesh_.lines_depth.push_back(-w);
    for (int i = 0; i < static_cast<int>(u_.size()); ++i)
      for (int k = 0; k < static_cast<int>(w_.size()); ++k)
        if (is_cut(i, k)) {
          const int left = node(i, plane_, k), right = static_cast<int>(mesh_.points.size());
          mesh_.points.push_back(mesh_.points[left]);
          mesh_.skin_above.push_back(k == 0 ? right : right_of_[node(i, plane_, 0)]);
          mesh_.pairs.push_back({left, right, {0, 1, 0}, 0, u_[i], -w_[k]});
          right_of_[left] = right;
        }
  }

  /// The node at a grid place as seen by an element that reaches to the right (j >= plane) or to the left of
  /// the cut.
  int seen(int i, int j, int k, bool from_right) const {
    return from_right ? right_of_[node(i, j, k)] : node(i, j, k);
  }

  void add_elements() {
    const int bottom_layer = static_cast<int>(w_.size()) - 1;
    for (int k = 0; k < bottom_layer; ++k)
      for (int j = 0; j + 1 < static_cast<int>(v_.size()); ++j)
        for (int i = 0; i + 1 < static_cast<int>(u_.size()); ++i)
          for (const auto& triangle : triangles_of_square(i, j)) {
            std::array<int, 3> upper, lower;
            for (int c = 0; c < 3; ++c) {
              const auto [ci, cj] = triangle[c];
              upper[c] = seen(ci, cj, k, j >= plane_);
              lower[c] = seen(ci, cj, k + 1, j >= plane_);
            }
            mesh_.wedges.push_back({lower[0], lower[1], lower[2], upper[0], upper[1], upper[2]});
            if (k == 0) mesh_.skin.push_back(upper);
            if (k + 1 == bottom_layer) mesh_.bottom.push_back(lower);
          }
  }

  using Corner = std::pair<int, int>;
  std::array<std::array<Corner, 3>, 2> triangles_of_square(int i, int j) const {
    const Corner a{i, j}, b{i + 1, j}, c{i + 1, j + 1}, d{i, j + 1};
    if (j >= plane_) return {{{a, b, c}, {a, c, d}}};
    return {{{a, b, d}, {b, c, d}}};
  }

  void add_sides() {
    const int nu = static_cast<int>(u_.size()), nv = static_cast<int>(v_.size()),
              nw = static_cast<int>(w_.size());
    for (int k = 0; k + 1 < nw; ++k) {
      for (int i = 0; i + 1 < nu; ++i)
        for (const int j : {0, nv - 1})
          mesh_.sides.push_back({node(i, j, k), node(i + 1, j, k), node(i + 1, j, k + 1), node(i, j, k + 1)});
      for (int j = 0; j + 1 < nv; ++j)
        for (const int i : {0, nu - 1})
          mesh_.sides.push_back({node(i, j, k), node(i, j + 1, k), node(i, j + 1, k + 1), node(i, j, k + 1)});
    }
  }

  const Parameters& p_;
  std::vector<double> u_, v_, w_;
  int plane_;  ///< index of v = 0
  std::vector<int> right_of_;
  PatchMesh mesh_;
};

}  // namespace

PatchMesh make_patch_mesh(const Parameters& parameters) { return PatchMesher(parameters).mesh(); }

Release make_release(const PatchMesh& mesh, const Parameters& p) {
  Release r;
  const auto nearest = [](const std::vector<double>& lines, double place) {
    return *std::min_element(lines.begin(), lines.end(),
                             [=](double a, double b) { return std::abs(a - place) < std::abs(b - place); });
  };
  const std::vector<double>& lines = mesh.lines_along[0];
  r.start = nearest(lines, -p.cut.length / 2);
  const double end = nearest(lines, p.cut.length / 2);
  r.length = end - r.start;
  r.depth = nearest(mesh.lines_depth, p.cut.depth);
  r.released = {0};
  r.position = {r.start};
  r.times = {0};
  const auto open = [&](const NodePair& pair) {
    return pair.along > r.start && pair.along < end && pair.depth < r.depth;
  };
  for (std::size_t n = 0; n < mesh.pairs.size();) {
    std::vector<int> column;
    const double along = mesh.pairs[n].along;
    for (; n < mesh.pairs.size() && mesh.pairs[n].along == along; ++n)
      if (open(mesh.pairs[n])) column.push_back(static_cast<int>(n));
    const double next = *std::upper_bound(lines.begin(), lines.end(), along);
    for (std::size_t m = 0; m < column.size(); ++m) {
      r.order.push_back(column[m]);
      if (m + 1 < column.size() && p.cut.frames != "pair") continue;
      r.released.push_back(static_cast<int>(r.order.size()));
      r.position.push_back(along +
                           (next - along) * static_cast<double>(m + 1) / static_cast<double>(column.size()));
      r.times.push_back(r.position.back() - r.start);
    }
  }
  for (std::size_t n = 0; n < mesh.pairs.size(); ++n)
    if (!open(mesh.pairs[n])) r.order.push_back(static_cast<int>(n));
  return r;
}

}  // namespace cleft
