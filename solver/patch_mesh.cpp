#include "solver/patch_mesh.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/error.h"
#include "base/text.h"
#include "solver/patch_mesh_grid.h"
#include "solver/shaped_mesh.h"

namespace cleft {

namespace {

constexpr double flattest = 0.05;  // area of a triangle over its area before its nodes were moved

class PatchMesher {
 public:
  explicit PatchMesher(const Parameters& p)
      : p_(p),
        lines_(p.mesh.elements == ElementOrder::quadratic ? 2 : 1),
        grid_(lines_ == 2 ? halved(make_patch_grid(p)) : make_patch_grid(p)) {}

  PatchMesh mesh() {
    add_points();
    add_cuts();
    if (p_.cut.branch > 0) add_branch();
    add_elements(1, mesh_);
    add_sides(1, mesh_);
    if (lines_ == 2) {
      add_elements(2, mesh_.quadratic);
      add_sides(2, mesh_.quadratic);
    }
    if (p_.patch.bottom == PatchBottom::bone) mesh_.on_bone.assign(mesh_.bottom.size(), true);
    if (has_coordinates(p_)) give_shape(mesh_, grid_, grid_node_, p_);
    return std::move(mesh_);
  }

 private:
  int columns_u() const { return static_cast<int>(grid_.u.size()); }
  int columns_v() const { return static_cast<int>(grid_.v.size()); }
  int layers() const { return static_cast<int>(grid_.w.size()) - 1; }
  int node(int i, int j, int k) const { return (k * columns_v() + j) * columns_u() + i; }

  void add_points() {
    mesh_.grid = {columns_u(), columns_v(), layers() + 1};
    for (int k = 0; k <= layers(); ++k)
      for (int j = 0; j < columns_v(); ++j)
        for (int i = 0; i < columns_u(); ++i) {
          mesh_.points.push_back(grid_.point(i, j, k));
          mesh_.skin_above.push_back(node(i, j, 0));
          grid_node_.push_back(node(i, j, k));
        }
    for (int k = 0; k <= grid_.bottom; ++k) mesh_.lines_depth.push_back(std::abs(grid_.w[k]));
  }

  void add_cuts() {
    right_of_.resize(mesh_.points.size());
    std::iota(right_of_.begin(), right_of_.end(), 0);
    const int ends = static_cast<int>(grid_.along.size()) - 1;
    mesh_.start = grid_.start, mesh_.fronts = grid_.fronts;
    for (const int plane : grid_.planes) {
      const int incision = static_cast<int>(mesh_.lines_along.size());
      mesh_.lines_along.push_back(grid_.along);
      for (int n = 1; n < ends; ++n)
        split_column(grid_.cut_from + n, plane, right_of_,
                     {0, 0, grid_.cut_normal(n), incision, grid_.along[n]});
    }
  }

  void add_branch() {
    right_of_branch_.resize(mesh_.points.size());
    std::iota(right_of_branch_.begin(), right_of_branch_.end(), 0);
    std::vector<double> lines;
    for (int j = grid_.planes[0]; j <= grid_.branch_v; ++j) {
      lines.push_back(grid_.v[j]);
      if (j < grid_.branch_v)
        split_column(grid_.branch_u, j, right_of_branch_, {0, 0, {1, 0, 0}, 1, grid_.v[j]});
    }
    mesh_.lines_along.push_back(lines);
  }

  /// Doubles the nodes of a column from the skin to the cut's bottom, with `pair` for what they have in
  /// common. The right node is the duplicate; where a branch begins, of the first cut's right node.
  void split_column(int i, int j, std::vector<int>& right_of, NodePair pair) {
    const int top = static_cast<int>(mesh_.points.size());
    for (int k = 0; k < grid_.bottom; ++k) {
      pair.left = right_of_[node(i, j, k)];
      pair.right = static_cast<int>(mesh_.points.size());
      pair.depth = mesh_.lines_depth[k];
      mesh_.points.push_back(mesh_.points[pair.left]);
      mesh_.skin_above.push_back(top);
      grid_node_.push_back(node(i, j, k));
      mesh_.pairs.push_back(pair);
      right_of[pair.left] = pair.right;
    }
  }

  using Place = std::pair<int, int>;  // u line, v line

  /// The node at a place of the grid for the elements of a square; the square's first corner determines their
  /// side of the cuts.
  int seen(Place place, int k, Place square) const {
    const auto [i, j] = place;
    const int n = square.second == j ? right_of_[node(i, j, k)] : node(i, j, k);
    return square.first == i && i == grid_.branch_u ? right_of_branch_[n] : n;
  }

  /// Elements between each line and the `step`-th after it.
  void add_elements(int step, WedgeCells& cells) {
    for (int k = 0; k < layers(); k += step)
      for (int j = 0; j + step < columns_v(); j += step)
        for (int i = 0; i + step < columns_u(); i += step)
          for (const auto& triangle : triangles_of_square(i, j, step)) {
            std::array<int, 3> upper, lower;
            for (int c = 0; c < 3; ++c) {
              upper[c] = seen(triangle[c], k, {i, j});
              lower[c] = seen(triangle[c], k + step, {i, j});
            }
            check_area(upper, i, j);
            check_area(lower, i, j);
            cells.wedges.push_back({lower[0], lower[1], lower[2], upper[0], upper[1], upper[2]});
            if (k == 0) cells.skin.push_back(upper);
            if (k + step == layers()) cells.bottom.push_back(lower);
            if (step == 2) add_middles(triangle, k, {i, j});
          }
  }

  /// Of the quadratic wedge below a triangle.
  void add_middles(const std::array<Place, 3>& triangle, int k, Place square) {
    const auto between = [&](int a, int b, int layer) {
      const auto [i, j] = triangle[a % 3];
      const auto [m, n] = triangle[b % 3];
      return seen({(i + m) / 2, (j + n) / 2}, layer, square);
    };
    const auto layer = [&](int corner) { return corner < 3 ? k + 2 : k; };
    WedgeMiddles middles{};
    for (std::size_t e = 0; e < wedge_edges.size(); ++e) {
      const auto [a, b] = wedge_edges[e];
      middles.edges[e] = between(a, b, (layer(a) + layer(b)) / 2);
    }
    for (std::size_t f = 0; f < wedge_quads.size(); ++f)
      middles.faces[f] = between(wedge_quads[f][0], wedge_quads[f][1], k + 1);
    mesh_.middles.push_back(middles);
  }

  std::array<std::array<Place, 3>, 2> triangles_of_square(int i, int j, int step) const {
    const Place a{i, j}, b{i + step, j}, c{i + step, j + step}, d{i, j + step};
    const auto rows = [&](int line, int first) { return (line - line % lines_ - first) / lines_; };
    if (diagonal_rises(has_chess_board(p_), rows(i, grid_.cut_from), rows(j, grid_.planes[0])))
      return {{{a, b, c}, {a, c, d}}};
    return {{{a, b, d}, {b, c, d}}};
  }

  /// A wedge's horizontal sections change linearly from its lower to its upper triangle, since nodes move in
  /// v only: it is sound where both are.
  void check_area(const std::array<int, 3>& triangle, int i, int j) const {
    const Vec3 a = mesh_.points[triangle[0]], b = mesh_.points[triangle[1]], c = mesh_.points[triangle[2]];
    const double before = std::abs((grid_.u[i + 1] - grid_.u[i]) * (grid_.v[j + 1] - grid_.v[j]));
    if (cross(b - a, c - a).z < flattest * before)
      throw InputError("cut.radius = " + shortest(p_.cut.radius) + " mm, cut.tilt = " +
                       shortest(p_.cut.tilt) + " degrees: the elements at u, v, w = " + shortest(a.x) + ", " +
                       shortest(a.y) + ", " + shortest(a.z) +
                       " mm would be flat or turned over; make the cut straighter, or raise "
                       "patch.width = " +
                       shortest(p_.patch.width) + " mm");
  }

  void add_sides(int step, WedgeCells& cells) {
    const int nu = columns_u(), nv = columns_v();
    const auto add = [&](int i, int j, int m, int n, int k) {
      cells.sides.push_back({node(i, j, k), node(m, n, k), node(m, n, k + step), node(i, j, k + step)});
    };
    for (int k = 0; k < layers(); k += step) {
      for (int i = 0; i + step < nu; i += step)
        for (const int j : {0, nv - 1}) add(i, j, i + step, j, k);
      for (int j = 0; j + step < nv; j += step)
        for (const int i : {0, nu - 1}) add(i, j, i, j + step, k);
    }
  }

  const Parameters& p_;
  const int lines_;  // from an element's line to the next
  const PatchGrid grid_;
  std::vector<int> right_of_, right_of_branch_;  // by node: itself where it is not doubled
  std::vector<int> grid_node_;                   // by node: that of the grid at its place
  PatchMesh mesh_;
};

}  // namespace

bool diagonal_rises(bool chess_board, int i, int j) { return (chess_board ? i + j : j) % 2 == 0; }

std::vector<bool> in_faces(const PatchMesh& mesh) {
  std::vector<bool> all(mesh.points.size(), false);
  for (const WedgeMiddles& middles : mesh.middles)
    for (const int node : middles.faces) all[node] = true;
  return all;
}

void fill_faces(const PatchMesh& mesh, std::vector<Vec3>& values) {
  if (!mesh.is_quadratic()) return;
  for (std::size_t e = 0; e < mesh.middles.size(); ++e)
    for (std::size_t f = 0; f < wedge_quads.size(); ++f) {
      // Opposite ones are added first: elements on either side of a face get the same bits.
      const auto sum = [&](const std::array<int, 4>& around, const auto& nodes) {
        const auto at = [&](int k) { return values[nodes[around[k]]]; };
        return (at(0) + at(2)) + (at(1) + at(3));
      };
      values[mesh.middles[e].faces[f]] = part_of_side * sum(sides_of_quad[f], mesh.middles[e].edges) +
                                         part_of_corner * sum(wedge_quads[f], mesh.quadratic.wedges[e]);
    }
  const std::vector<bool> in_face = in_faces(mesh);
  for (std::size_t p = 1; p < mesh.pairs.size(); ++p) {
    const NodePair &pair = mesh.pairs[p], &above = mesh.pairs[p - 1];
    if (in_face[pair.left] && values[above.left] == values[above.right])
      values[pair.left] = values[pair.right] = 0.5 * (values[pair.left] + values[pair.right]);
  }
}

PatchMesh make_patch_mesh(const Parameters& parameters) { return PatchMesher(parameters).mesh(); }

}  // namespace cleft
