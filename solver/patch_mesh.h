// The box of tissue with its pre-meshed cut: wedges, skin triangles, boundary faces and duplicated nodes.
// Paper, section 3.1.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "base/vec3.h"
#include "params/meshed_cut.h"
#include "params/parameters/parameters.h"
#include "params/region_material.h"

namespace cleft {

/// Two nodes at one place, on either side of a cut.
struct NodePair {
  int left, right;   ///< a right node is the left one of later pairs only
  Vec3 normal;       ///< of the cut, unit, from left to right
  int incision = 0;  ///< which of several cuts: 0, 1, ... in the order in which they are made
  double along = 0;  ///< mm along the cut, from its middle (a branch: from where it leaves the first cut)
  double depth = 0;  ///< mm below the skin
};

/// Wedges and their faces on the surface, by the nodes at their corners.
struct WedgeCells {
  std::vector<std::array<int, 6>> wedges;  ///< lower triangle, then upper, both counter-clockwise from above
  std::vector<std::array<int, 3>> skin;    ///< top faces, of the first wedges; counter-clockwise from above
  std::vector<std::array<int, 3>> bottom;  ///< bottom faces
  std::vector<std::array<int, 4>> sides;   ///< side faces, cyclic
};

/// The nodes of a quadratic wedge beside its corners.
struct WedgeMiddles {
  std::array<int, 9> edges;  ///< of those of wedge_edges
  std::array<int, 3> faces;  ///< of the faces between the corners of wedge_quads
};
/// Corners and sides of the upright faces go around them.
inline constexpr std::array<std::array<int, 2>, 9> wedge_edges = {
    {{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}}};
inline constexpr std::array<std::array<int, 4>, 3> wedge_quads = {{{0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}}};
/// Of each of wedge_quads: its sides, as numbers of wedge_edges.
inline constexpr std::array<std::array<int, 4>, 3> sides_of_quad = {
    {{0, 7, 3, 6}, {1, 8, 4, 7}, {2, 6, 5, 8}}};

/// Node numbers index `points`. The mesh depends on the parameters alone, not on the number of ranks.
struct PatchMesh : WedgeCells {
  std::vector<Vec3> points;     ///< (u, v, w), or of a body or shaped patch in space, closed, mm
  std::vector<int> skin_above;  ///< by node: the node of the skin in the same column
  std::vector<NodePair>
      pairs;  ///< every duplicated node: incision by incision, along each, from the skin down
  /// Positions of the nodes of each incision, including its ends and its bottom (single nodes, except for the
  /// start of a branch): mm along it, and mm below the skin; both increase. The cut ends inside the outermost
  /// ones (fronts).
  std::vector<std::vector<double>> lines_along;
  std::vector<double> lines_depth;
  Vec3 start;  ///< of the first cut, on the skin
  Fronts fronts;
  /// The nodes without the duplicates (the right nodes of pairs) form a grid: number (k grid[1] + j) grid[0]
  /// + i, i along u, j along v, k downward.
  std::array<int, 3> grid{};

  /// Of quadratic elements; else empty: each is made of eight of the wedges, whose nodes it has as corners
  /// and middles. Those in the middle of its three upright faces have no unknowns: the element has 15 nodes,
  /// and there its displacement is that of fill_faces.
  WedgeCells quadratic;
  std::vector<WedgeMiddles> middles;  ///< by quadratic.wedges
  bool is_quadratic() const { return !middles.empty(); }
  int lines_of_element() const { return is_quadratic() ? 2 : 1; }  ///< from one of its sides to the opposite
  const WedgeCells& elements() const { return is_quadratic() ? quadratic : *this; }

  /// Of a body (solver/body_mesh.h), which has no lines and no grid, and of a shaped patch; else empty.
  std::vector<Vec3> tension;  ///< by triangle of skin: the direction of skin.prestress_u
  std::vector<bool> on_bone;  ///< by face of the bottom; also of a patch on bone
  /// Of a body with regions; else empty: what these are made of, and the number of each wedge's.
  std::vector<RegionMaterial> materials;
  std::vector<std::uint8_t> region;

  /// Of a patch that is shaped or whose cut is tilted (has_coordinates); else empty: by node, coordinates of
  /// the cut (u along it, v across it, w = -depth below the skin, mm), and unit vectors of these directions
  /// in space.
  std::vector<Vec3> canonical;
  std::vector<std::array<Vec3, 3>> frames;

  bool is_body() const { return grid[0] == 0; }
  bool is_shaped() const { return !is_body() && !tension.empty(); }  ///< a patch that is not a box
  /// Along which skin.prestress_u pulls the triangle on a wedge.
  Vec3 tension_of(int wedge) const { return tension.empty() ? Vec3{1, 0, 0} : tension[wedge]; }
};

/// The surface of every cut coincides with element faces, and its ends and its bottom lie just inside nodes
/// (params/meshed_cut.h). Elements are at most mesh.element_size long within the cut (an arc: along it),
/// between parallel cuts and along a branch; away from them they grow by mesh.grading. Under a tilted blade
/// they are shorter along the cut, and narrower next to its lips. The mesh is made for a cut of
/// mesh.cut_length by mesh.cut_depth if these are given; a branch has its own length always, and leaves
/// toward +v where u = 0: its nodes on the first cut have three copies, in the pairs (left, right with u <
/// 0) and then (right with u < 0, right with u > 0). Nodes move in v only onto a curved or tilted cut, and
/// the patch stays a box; then a patch that is_shaped gets its shape (solver/shaped_mesh.h). An upright
/// straight cut's triangles are mirrored in v = 0 (several cuts: where the squares between them are even in
/// number); those of a chess board (diagonal_rises) in u = 0 too where the squares along u are even in
/// number. Throws InputError if moving the nodes would flatten an element. With quadratic elements all this
/// is said of them: nodes lie in the middle between their lines too, and an element's squares are halved by
/// one diagonal.
PatchMesh make_patch_mesh(const Parameters& parameters);

/// By node: whether it is in the middle of a quadratic element's upright face, and has no unknowns.
std::vector<bool> in_faces(const PatchMesh& mesh);

/// What the nodes around a quadratic element's upright face give to that in its middle: each corner, and the
/// middle of each side.
inline constexpr double part_of_corner = -0.25, part_of_side = 0.5;

/// Gives the nodes in the middle of quadratic elements' upright faces the values that the other eight nodes
/// of the face determine. Pairs in a column that is closed stay together.
void fill_faces(const PatchMesh& mesh, std::vector<Vec3>& values);

/// Whether square (i, j), counted along u and v from the first cut's start, is halved by the diagonal that
/// rises from (i, j). Rows of squares alternate: all columns of nodes are equally compliant, so that the
/// displacement follows the tip smoothly. Of a `chess_board` squares alternate like its colours: in tissue
/// that is nearly incompressible motions in the plane lock except at nodes of four triangles between two
/// straight lines, whose volumes are not independent. Nodes of four triangles are next to nodes of eight,
/// whose compliance differs, so that every other frame differs slightly.
bool diagonal_rises(bool chess_board, int i, int j);

/// How the cut of a case opens in its mesh.
struct Release {
  std::vector<int> order;     ///< all pairs of the mesh in release order; those that stay closed last
  std::vector<int> released;  ///< by frame: how many of them are open; released[0] = 0
  std::vector<double>
      position;  ///< by frame: place of the tip along the incision being made, mm; u for a straight cut
  std::vector<double> times;                ///< by frame: length cut so far, mm
  double start = 0, length = 0, depth = 0;  ///< of the first cut in the mesh, mm

  /// By pair, where the first `open` of them are open.
  std::vector<bool> closed(int open) const {
    std::vector<bool> pairs(order.size(), true);
    for (int i = 0; i < open; ++i) pairs[order[i]] = false;
    return pairs;
  }
};

/// Frame 0 is closed; then a frame for each released column, or pair (cut.frames). Columns open one after the
/// other along an incision, each from the skin down. A column of m of its M pairs released has brought the
/// tip the fraction m / M of the way to the next column. The tip, and the ends of the cut, are inside the
/// first closed nodes by the mesh's fronts. The cut of the case ends at the places of fronts nearest to
/// cut.length and cut.depth (the nearest ones that leave a pair to open).
Release make_release(const PatchMesh& mesh, const Parameters& parameters);

}  // namespace cleft
