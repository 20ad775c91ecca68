// A triangle mesh that is cut and refined in place: every change updates its neighbourhood only, and can be
// taken back.
#pragma once

#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "encoder/field/field.h"
#include "explorer/incision/surface_mesh.h"

namespace cleft {

enum class Region : std::uint8_t { skin, left_wall, right_wall };

/// What a vertex is. `shared` vertices belong to both sides: the start and the tip with the columns of wall
/// below them, and the bottom of the walls.
enum class VertexKind : std::uint8_t { skin, left_lip, right_lip, left_wall, right_wall, shared };

inline Side side_of(VertexKind kind) {
  const bool left = kind == VertexKind::left_lip || kind == VertexKind::left_wall;
  return left                                                     ? Side::left
         : kind == VertexKind::skin || kind == VertexKind::shared ? Side::both
                                                                  : Side::right;
}

class CutMesh {
 public:
  static constexpr int boundary = -1;      ///< neighbour across an edge with one triangle
  static constexpr int non_manifold = -2;  ///< across an edge with more than two, or whose two disagree

  struct Triangle {
    std::array<int, 3> vertex;
    std::array<int, 3> neighbor;  ///< [i] lies across the edge vertex[i], vertex[i + 1]
    Region region = Region::skin;

    int corner(int v) const { return vertex[0] == v ? 0 : vertex[1] == v ? 1 : vertex[2] == v ? 2 : -1; }
  };

  struct Vertex {
    Vec3 position;
    Vec3 original;  ///< where it stood before it was moved onto the path
    int triangle;   ///< one of those around it
    VertexKind kind = VertexKind::skin;
    double s =
        std::numeric_limits<double>::quiet_NaN();  ///< along the path; only lips, walls and ends have one
    double depth_fraction = 0;                     ///< 0 at the skin, 1 at the bottom of the wall
  };

  /// Throws InputError for an index out of range.
  explicit CutMesh(const SurfaceMesh& surface);

  const std::vector<Triangle>& triangles() const { return triangles_; }
  const std::vector<Vertex>& vertices() const { return vertices_; }
  const Triangle& triangle(int t) const { return triangles_[t]; }
  const Vertex& vertex(int v) const { return vertices_[v]; }
  const Vec3& position(int v) const { return vertices_[v].position; }
  SurfaceMesh surface() const;

  /// The skin triangles around v, counter-clockwise; where the fan is open it begins at its clockwise end.
  /// Throws InputError where the mesh is not a manifold there.
  std::vector<int> skin_fan(int v) const;
  bool on_boundary(int v) const;

  /// The least height of v over an edge opposite to it in its fan: how far it may move.
  double room(int v) const;

  /// The triangle of v's skin fan that contains the directed edge v -> w, or -1.
  int triangle_with(int v, int w) const;

  /// A new vertex at `place` on edge i of t: two triangles become four.
  int split_edge(int t, int i, const Vec3& place);
  /// A new vertex inside t: one triangle becomes three.
  int split_face(int t, const Vec3& place);

  int add_vertex(const Vertex& vertex);
  int add_triangle(const std::array<int, 3>& vertex, Region region);
  Vertex& edit_vertex(int v);
  Triangle& edit(int t);
  /// Makes a and b neighbours across the edge from -> to of a, which is to -> from in b.
  void link(int a, int b, int from, int to);
  void unlink(int t, int from, int to);

  /// From here on changes are remembered until the next mark.
  void mark();
  void roll_back();

 private:
  void set_neighbor(int t, int from, int to, int neighbor);
  [[noreturn]] void report_non_manifold(int v) const;

  std::vector<Triangle> triangles_;
  std::vector<Vertex> vertices_;
  std::vector<bool> bow_tie_;  // input vertices whose triangles form more than one fan

  bool recording_ = false;
  std::size_t marked_triangles_ = 0, marked_vertices_ = 0;
  std::vector<std::pair<int, Triangle>> old_triangles_;
  std::vector<std::pair<int, Vertex>> old_vertices_;
};

}  // namespace cleft
