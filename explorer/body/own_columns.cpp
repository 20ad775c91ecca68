#include "explorer/body/own_columns.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <unordered_map>

#include "base/error.h"
#include "base/text.h"
#include "base/wedge.h"
#include "explorer/body/skin_coordinates.h"
#include "solver/snapshot/cell_types.h"

namespace cleft {

namespace {

/// VTK's numbers of cells.
namespace vtk {
constexpr int poly_line = 4, triangle = 5, quad = 9, tetrahedron = 10, hexahedron = 12, wedge = 13,
              pyramid = 14, quadratic_edge = 21;
}

constexpr double same_place = 1e-6;  // of the shortest edge
constexpr double too_near = 0.25;    // of the shortest edge: no two nodes of a sound mesh are so near

template <class Nodes>
std::vector<int> key_of(const Nodes& nodes) {
  std::vector<int> key(nodes.begin(), nodes.end());
  std::sort(key.begin(), key.end());
  return key;
}

/// Finds points that are near each other.
class NearPoints {
 public:
  NearPoints(const std::vector<Vec3>& points, double reach) : points_(points), reach_(reach) {}

  /// Calls visit(number) of each point added before that is within the reach, then adds this one.
  template <class Visit>
  void add(int number, const Visit& visit) {
    const Vec3& p = points_[number];
    const std::array<long long, 3> cell = {index(p.x), index(p.y), index(p.z)};
    for (long long i = -1; i <= 1; ++i)
      for (long long j = -1; j <= 1; ++j)
        for (long long k = -1; k <= 1; ++k) {
          const auto found = cells_.find(hash(cell[0] + i, cell[1] + j, cell[2] + k));
          if (found == cells_.end()) continue;
          for (const int other : found->second)
            if (norm(points_[other] - p) <= reach_) visit(other);
        }
    cells_[hash(cell[0], cell[1], cell[2])].push_back(number);
  }

 private:
  long long index(double x) const { return static_cast<long long>(std::floor(x / reach_)); }
  static std::uint64_t hash(long long i, long long j, long long k) {
    return static_cast<std::uint64_t>(i) * 73856093U ^ static_cast<std::uint64_t>(j) * 19349663U ^
           static_cast<std::uint64_t>(k) * 83492791U;
  }
  const std::vector<Vec3>& points_;
  double reach_;
  std::unordered_map<std::uint64_t, std::vector<int>> cells_;
};

class Columns {
 public:
  Columns(const OwnMesh& mesh, const OwnFaces& faces) : m_(mesh), f_(faces) { c_.points = mesh.points; }

  OwnColumns run() {
    check_cells();
    weld();
    list_faces();
    c_.above.assign(m_.points.size(), -1), c_.depth.assign(m_.points.size(), 0);
    used_.assign(m_.types.size(), false);
    for (const int cell : skin_) m_.types[cell] == vtk::triangle ? grow_wedges(cell) : grow_hexahedra(cell);
    for (std::size_t c = 0; c < used_.size(); ++c)
      if (is_volume(m_.types[c]) && !used_[c])
        refuse(static_cast<int>(c),
               "does not hang from the skin: below each of its triangles wedges must go "
               "down one below the other. In gmsh: Extrude { ... Layers { ... }; Recombine; }");
    check_orientation();
    find_sides();
    return std::move(c_);
  }

 private:
  [[noreturn]] void refuse(int cell, const std::string& what) const {
    Vec3 middle;
    for (const int n : m_.nodes[cell])
      middle += 1. / static_cast<double>(m_.nodes[cell].size()) * m_.points[n];
    throw FileError(m_.name, "cell " + std::to_string(cell) + " at " + place_text(middle) + " mm " + what);
  }

  static bool is_volume(int type) { return type == vtk::wedge || type == vtk::hexahedron; }

  void check_cells() const {
    for (const Vec3& p : m_.points)
      if (!std::isfinite(squared_norm(p)))
        throw FileError(m_.name, "point " + std::to_string(&p - m_.points.data()) + " is not finite");
    bool any = false;
    for (std::size_t c = 0; c < m_.types.size(); ++c) {
      const int type = m_.types[c];
      any = any || is_volume(type);
      if (is_volume(type) || type == vtk::triangle || type == vtk::quad || type <= vtk::poly_line) continue;
      const std::string number = " (VTK's type " + std::to_string(type) + ")";
      if (type == vtk::tetrahedron || type == vtk::pyramid)
        refuse(static_cast<int>(c),
               std::string("is a ") + (type == vtk::pyramid ? "pyramid" : "tetrahedron") + number +
                   ": only wedges and hexahedra in columns below the skin are solved. Extrude "
                   "the skin's triangles inward in layers (gmsh: Extrude { ... Layers { ... }; "
                   "Recombine; })");
      refuse(static_cast<int>(c),
             "is of a kind that is not solved" + number + ": " +
                 (type >= vtk::quadratic_edge ? "make its elements linear (gmsh: Mesh.ElementOrder = 1)"
                                              : "use wedges or hexahedra, and triangles or quads"));
    }
    if (!any) throw FileError(m_.name, "has neither wedges nor hexahedra");
  }

  /// Finds nodes at one place, and gives them one position.
  void weld() {
    double shortest_edge = std::numeric_limits<double>::infinity();
    for (std::size_t c = 0; c < m_.types.size(); ++c)
      if (is_volume(m_.types[c]))
        for (const auto& [a, b] : edges_of_type(m_.types[c])) {
          const double length = norm(m_.points[m_.nodes[c][a]] - m_.points[m_.nodes[c][b]]);
          if (length == 0) refuse(static_cast<int>(c), "has two corners at one place");
          shortest_edge = std::min(shortest_edge, length);
        }
    std::vector<bool> of_volume(m_.points.size(), false);
    for (std::size_t c = 0; c < m_.types.size(); ++c)
      if (is_volume(m_.types[c]))
        for (const int n : m_.nodes[c]) of_volume[n] = true;
    c_.place.resize(m_.points.size());
    NearPoints near(m_.points, too_near * shortest_edge);
    for (int n = 0; n < static_cast<int>(m_.points.size()); ++n) {
      c_.place[n] = n;
      if (!of_volume[n]) continue;
      near.add(n, [&](int other) {
        const double apart = norm(m_.points[n] - m_.points[other]);
        if (apart > same_place * shortest_edge)
          throw FileError(m_.name,
                          "nodes " + std::to_string(other) + " and " + std::to_string(n) + " at " +
                              place_text(m_.points[n]) + " mm are " + shortest(apart) +
                              " mm apart, less than any edge: the two nodes of a pair must be at one "
                              "place. Move one onto the other, or merge them");
        c_.place[n] = std::min(c_.place[n], c_.place[other]);
      });
      c_.points[n] = m_.points[c_.place[n]];
    }
  }

  void list_faces() {
    const bool triangles = std::find(m_.types.begin(), m_.types.end(), vtk::triangle) != m_.types.end();
    for (int c = 0; c < static_cast<int>(m_.types.size()); ++c) {
      const auto& nodes = m_.nodes[c];
      if (m_.types[c] == vtk::wedge) {
        cells_at_[key_of(std::array{nodes[0], nodes[1], nodes[2]})].push_back(c);
        cells_at_[key_of(std::array{nodes[3], nodes[4], nodes[5]})].push_back(c);
      } else if (m_.types[c] == vtk::hexahedron) {
        static constexpr int faces[6][4] = {{0, 1, 2, 3}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                            {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
        for (const auto& f : faces)
          cells_at_[key_of(std::array{nodes[f[0]], nodes[f[1]], nodes[f[2]], nodes[f[3]]})].push_back(c);
      } else if (m_.types[c] == vtk::triangle || m_.types[c] == vtk::quad) {
        const int region = m_.regions.empty() ? 0 : m_.regions[c];
        if (f_.all_skin ? m_.types[c] == vtk::triangle || !triangles : f_.skin.contains(region))
          skin_.push_back(c);
        if (f_.free.contains(region)) free_.insert(key_of(nodes));
        if (!f_.bone.contains(region)) continue;
        for (std::size_t left_out = 0; left_out < (nodes.size() == 4 ? 4U : 1U); ++left_out) {
          std::vector<int> three = nodes;
          if (nodes.size() == 4) three.erase(three.begin() + static_cast<long>(left_out));
          bone_.insert(key_of(three));
        }
      }
    }
    if (skin_.empty()) throw FileError(m_.name, "has no skin: no triangles or quads on its outer surface");
  }

  /// The cell below a face that is not used yet; -1: none.
  int below(const std::vector<int>& face) const {
    const auto found = cells_at_.find(key_of(face));
    if (found == cells_at_.end()) return -1;
    for (const int cell : found->second)
      if (!used_[cell]) return cell;
    return -1;
  }

  /// The corners of a cell opposite to a face's, by the edges between.
  std::vector<int> opposite(int cell, const std::vector<int>& face) const {
    std::vector<int> result;
    const auto in_face = [&](int n) { return std::find(face.begin(), face.end(), n) != face.end(); };
    for (const int n : face)
      for (const auto& [i, j] : edges_of_type(m_.types[cell])) {
        const int a = m_.nodes[cell][i], b = m_.nodes[cell][j];
        if ((a == n && !in_face(b)) || (b == n && !in_face(a))) result.push_back(a == n ? b : a);
      }
    return result;
  }

  void grow_wedges(int face) {
    begin_columns({m_.nodes[face]});
    std::vector<int> upper = m_.nodes[face];
    for (int cell = below(upper); cell >= 0; cell = below(upper)) {
      const std::vector<int> lower = opposite(cell, upper);
      if (upper.size() != 3 || lower.size() != 3) refuse(cell, "has another shape than the one above it");
      add_layer(cell, {lower}, {upper});
      upper = lower;
    }
    end_columns(1, face);
  }

  void grow_hexahedra(int face) {
    std::vector<int> upper = m_.nodes[face];
    const auto halves = [](const std::vector<int>& q) {
      return std::vector<std::vector<int>>{{q[0], q[1], q[2]}, {q[0], q[2], q[3]}};
    };
    begin_columns(halves(upper));
    for (int cell = below(upper); cell >= 0; cell = below(upper)) {
      const std::vector<int> lower = opposite(cell, upper);
      if (m_.types[cell] != vtk::hexahedron || lower.size() != 4)
        refuse(cell, "has another shape than the one above it");
      add_layer(cell, halves(lower), halves(upper));
      upper = lower;
    }
    end_columns(2, face);
  }

  void begin_columns(const std::vector<std::vector<int>>& faces) {
    for (const auto& f : faces) {
      c_.skin.push_back({f[0], f[1], f[2]});
      c_.wedges.emplace_back(), c_.cells.emplace_back();
    }
  }

  void add_layer(int cell, const std::vector<std::vector<int>>& lower,
                 const std::vector<std::vector<int>>& upper) {
    used_[cell] = true;
    const std::size_t first = c_.skin.size() - lower.size();
    for (std::size_t h = 0; h < lower.size(); ++h) {
      c_.wedges[first + h].push_back(
          {lower[h][0], lower[h][1], lower[h][2], upper[h][0], upper[h][1], upper[h][2]});
      c_.cells[first + h].push_back(cell);
      for (int i = 0; i < 3; ++i) {
        const int low = lower[h][i], up = upper[h][i];
        if (c_.above[low] >= 0 && c_.place[c_.above[low]] != c_.place[up])
          refuse(cell, "hangs from two columns that come together; columns must stay apart");
        if (c_.above[low] < 0) c_.above[low] = up;
        c_.depth[low] = c_.depth[up] + norm(c_.points[low] - c_.points[up]);
      }
    }
  }

  void end_columns(int count, int face) {
    for (std::size_t c = c_.skin.size() - count; c < c_.skin.size(); ++c) {
      if (c_.wedges[c].empty())
        refuse(face, "is skin without a wedge or hexahedron below it, of which it must be a whole face");
      const auto& last = c_.wedges[c].back();
      c_.bottom.push_back({last[0], last[1], last[2]});
      c_.on_bone.push_back(bone_.contains(key_of(c_.bottom.back())));
    }
  }

  /// Turns columns whose triangle is clockwise from outside.
  void check_orientation() {
    for (std::size_t c = 0; c < c_.skin.size(); ++c) {
      const auto p = [&](int n) { return c_.points[n]; };
      auto& s = c_.skin[c];
      const auto& first = c_.wedges[c].front();
      if (dot(cross(p(s[1]) - p(s[0]), p(s[2]) - p(s[0])), p(first[3]) - p(first[0])) < 0) {
        std::swap(s[1], s[2]), std::swap(c_.bottom[c][1], c_.bottom[c][2]);
        for (auto& w : c_.wedges[c]) std::swap(w[1], w[2]), std::swap(w[4], w[5]);
      }
      for (std::size_t k = 0; k < c_.wedges[c].size(); ++k) {
        const auto& w = c_.wedges[c][k];
        const std::array<double, 6> determinants = corner_determinants([&](int i) { return p(w[i]); });
        for (int i = 0; i < 6; ++i) {
          if (!(determinants[i] > 0))
            refuse(c_.cells[c][k],
                   "is flat or turned inside out at " + place_text(p(w[i])) +
                       " mm; make the layers thinner, or the mesh coarser, where the skin is bent");
        }
      }
    }
  }

  void find_sides() {
    struct Side {
      int column, edge, layer;
      std::array<int, 4> nodes;
    };
    std::map<std::vector<int>, std::vector<Side>> by_nodes, by_places;
    for (int c = 0; c < static_cast<int>(c_.skin.size()); ++c)
      for (int k = 0; k < static_cast<int>(c_.wedges[c].size()); ++k)
        for (int i = 0; i < 3; ++i) {
          const auto& w = c_.wedges[c][k];
          const int j = (i + 1) % 3;
          const std::array<int, 4> nodes = {w[3 + i], w[3 + j], w[j], w[i]};
          by_nodes[key_of(nodes)].push_back({c, i, k, nodes});
        }
    for (const auto& [key, list] : by_nodes) {
      if (list.size() > 2)
        refuse(c_.cells[list[2].column][list[2].layer], "is the third at one of its faces");
      if (list.size() == 2) continue;
      std::array<int, 4> places;
      for (int i = 0; i < 4; ++i) places[i] = c_.place[list.front().nodes[i]];
      by_places[key_of(places)].push_back(list.front());
    }
    for (const auto& [key, list] : by_places) {
      const bool in_order = list.front().column <= list.back().column;
      const Side &a = in_order ? list.front() : list.back(), &b = in_order ? list.back() : list.front();
      if (list.size() > 2)
        refuse(c_.cells[list[2].column][list[2].layer], "is the third at one of its faces");
      if (list.size() == 1) {
        if (!free_.contains(key_of(a.nodes))) c_.sides.push_back(a.nodes);
        continue;
      }
      if (a.layer != b.layer)
        refuse(c_.cells[b.column][b.layer],
               "and the one on the other side of the cut are in different layers");
      c_.walls.push_back({{a.column, b.column}, {a.edge, b.edge}, a.layer});
    }
  }

  const OwnMesh& m_;
  const OwnFaces& f_;
  OwnColumns c_;
  std::vector<int> skin_;                                  // cells
  std::map<std::vector<int>, std::vector<int>> cells_at_;  // by face: those that have it as a whole
  std::set<std::vector<int>> free_, bone_;                 // faces, by their nodes
  std::vector<bool> used_;                                 // by cell
};

}  // namespace

OwnColumns columns_of(const OwnMesh& mesh, const OwnFaces& faces) { return Columns(mesh, faces).run(); }

}  // namespace cleft
