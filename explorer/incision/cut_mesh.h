// A triangle mesh that is cut and refined in place: every change affects its neighbourhood only, is logged,
// and can be undone and redone bit for bit.
//
// The walls of a cut are sheets of two layers: every triangle of the left wall has a twin of the right wall
// on the same three places. An edge of a wall or of a lip is split on both sides at once, so that the lips
// remain paired vertex by vertex.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "explorer/incision/cut_mesh_parts.h"
#include "explorer/incision/surface_mesh.h"

namespace cleft {

class CutMesh {
 public:
  static constexpr int boundary = -1;      ///< neighbour across an edge with one triangle
  static constexpr int non_manifold = -2;  ///< across an edge with more than two, or whose two disagree

  using Triangle = CutTriangle;
  using Vertex = CutVertex;
  using Sheet = CutSheet;
  using Undone = UndoneChanges;

  /// Throws InputError for an index out of range, and for a coordinate above 1e60.
  explicit CutMesh(const SurfaceMesh& surface);

  const std::vector<Triangle>& triangles() const { return triangles_; }
  const std::vector<Vertex>& vertices() const { return vertices_; }
  const std::vector<Sheet>& sheets() const { return sheets_; }
  bool is_wall(int t) const { return t >= 0 && triangles_[t].region != Region::skin; }
  bool is_skin(int t) const { return t >= 0 && triangles_[t].region == Region::skin; }
  const Triangle& triangle(int t) const { return triangles_[t]; }
  const Vertex& vertex(int v) const { return vertices_[v]; }
  const Vec3& position(int v) const { return vertices_[v].position; }
  SurfaceMesh surface() const;

  /// The skin triangles around v, counter-clockwise; an open fan begins at its clockwise end. Throws
  /// InputError if the mesh is not a manifold there.
  std::vector<int> skin_fan(int v) const;
  /// All triangles around v, including walls.
  std::vector<int> fan(int v) const { return fan(v, vertices_[v].triangle); }
  std::vector<int> fan(int v, int first) const;  ///< the fan that triangle `first` belongs to
  bool on_boundary(int v) const;                 ///< whether v's skin ends at a free edge
  bool on_wound(int v) const;  ///< whether v's skin ends at a wall: v is on a lip or ends a cut

  /// The least height of v over an edge opposite to it in its fan: how far it may move.
  double room(int v) const;

  /// The triangle of v's skin fan that contains the directed edge v -> w, or -1.
  int triangle_with(int v, int w) const;
  /// The same among all triangles around v.
  int any_triangle_with(int v, int w) const;

  /// The wall triangle of the other side on the same place; -1 for skin.
  int twin(int t) const;
  /// The twin's corner at the place of corner i, and the twin's edge at that of edge i.
  static int twin_corner(int i) { return (3 - i) % 3; }
  static int twin_edge(int i) { return 2 - i; }
  /// s and depth of corner i of a wall's triangle, in the parameters of the cut it belongs to.
  double wall_s(int t, int i) const;
  double wall_depth_fraction(int t, int i) const;

  /// A new vertex at `place` on edge i of t: two triangles become four. On a lip or a wall the same happens
  /// on the other side. The walls' s and depth are interpolated at `part` of the edge; s may be given.
  int split_edge(int t, int i, const Vec3& place, std::optional<double> s = std::nullopt);
  /// A new vertex inside t, of the skin: one triangle becomes three.
  int split_face(int t, const Vec3& place);
  /// Edge i of t, of the skin on both sides, becomes the other diagonal of its two triangles.
  void flip_edge(int t, int i);

  int add_vertex(const Vertex& vertex);
  int add_triangle(const std::array<int, 3>& vertex, Region region);
  int add_sheet(const Sheet& sheet);
  Vertex& edit_vertex(int v);
  Triangle& edit(int t);
  /// Moves a vertex: the triangles around it count as changed.
  void move_vertex(int v, const Vec3& place);
  /// Makes a and b neighbours across the edge from -> to of a, which is to -> from in b.
  void link(int a, int b, int from, int to);
  void unlink(int t, int from, int to);
  void set_neighbor(int t, int from, int to, int neighbor);

  /// A new cut's number, counted from 0. Reserves memory for the triangles of the cut, so that no step has to
  /// move the mesh in memory.
  int begin_cut();

  struct Checkpoint {
    std::size_t triangles, vertices, sheets, triangle_log, vertex_log, sheet_log;
  };
  Checkpoint checkpoint() const;
  /// The triangles changed or added since a checkpoint.
  std::vector<int> changed_since(const Checkpoint& checkpoint) const;
  /// By how much the Euler characteristic has changed since a checkpoint, from the changes alone.
  int euler_change_since(const Checkpoint& checkpoint) const;
  void roll_back(const Checkpoint& to);

  /// Returns the undone changes, for redo().
  Undone undo(const Checkpoint& to);
  /// Must be called on the mesh exactly as undo() left it.
  void redo(const Undone& undone);

  /// The numbers of the triangles that were changed, added, or removed (those are no longer in range) since
  /// the last forget_changes(): each once, in no order. A triangle counts as changed also if one of its
  /// corners moved.
  const std::vector<int>& changed() const { return changed_; }
  void forget_changes();

 private:
  int split_pair(int t, int i, const Vec3& place, std::vector<std::array<int, 3>>& parted);
  void split_sheets(const std::vector<std::array<int, 3>>& parted, double part, std::optional<double> s);
  Vertex new_on_edge(int t, int i, const Vec3& place, double part, std::optional<double> s) const;
  void rotate(int t);
  Sheet& edit_sheet(int i);
  void note(int t);
  template <class T>
  void undo(std::vector<T>& items, std::vector<std::pair<int, T>>& log, std::size_t count,
            std::size_t entries, std::vector<T>* taken, std::vector<std::pair<int, T>>* taken_log);
  [[noreturn]] void report_non_manifold(int v) const;

  std::vector<Triangle> triangles_;
  std::vector<Vertex> vertices_;
  std::vector<Sheet> sheets_;
  std::vector<bool> bow_tie_;  // input vertices whose triangles form more than one fan
  int cuts_ = 0;

  // Former values, oldest first.
  std::vector<std::pair<int, Triangle>> triangle_log_;
  std::vector<std::pair<int, Vertex>> vertex_log_;
  std::vector<std::pair<int, Sheet>> sheet_log_;

  std::vector<int> changed_;
  std::vector<std::uint32_t> noted_;  // the epoch in which a triangle was last put there
  std::uint32_t epoch_ = 1;
};

/// "(x, y, z)", for messages.
std::string place_of(const Vec3& p);

}  // namespace cleft
