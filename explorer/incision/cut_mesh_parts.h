// The parts of a mesh with cuts: triangles of the skin and of walls, vertices, and sheets of walls.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "base/vec3.h"
#include "encoder/field/field.h"

namespace cleft {

enum class Region : std::uint8_t { skin, left_wall, right_wall };

/// The role of a vertex in the first cut that reached it. `shared` vertices belong to both sides: the start
/// and the tip with the columns of wall below them, and the bottom of the walls.
enum class VertexKind : std::uint8_t { skin, left_lip, right_lip, left_wall, right_wall, shared };

inline Side side_of(VertexKind kind) {
  const bool left = kind == VertexKind::left_lip || kind == VertexKind::left_wall;
  return left                                                     ? Side::left
         : kind == VertexKind::skin || kind == VertexKind::shared ? Side::both
                                                                  : Side::right;
}

/// A triangle with its neighbours.
struct CutTriangle {
  std::array<int, 3> vertex;
  std::array<int, 3> neighbor;  ///< [i] is the neighbour across the edge vertex[i], vertex[i + 1]
  Region region = Region::skin;
  int sheet = -1;  ///< of a wall

  int corner(int v) const { return vertex[0] == v ? 0 : vertex[1] == v ? 1 : vertex[2] == v ? 2 : -1; }
};

/// A vertex, and its role in the cut that made it.
struct CutVertex {
  Vec3 position;
  Vec3 original;  ///< its position before it was moved onto the path
  int triangle;   ///< one of the triangles around it, of the skin if there is one
  VertexKind kind = VertexKind::skin;
  /// Along the path; only lips, walls and ends have one.
  double s = std::numeric_limits<double>::quiet_NaN();
  double depth_fraction = 0;  ///< 0 at the skin, 1 at the bottom of the wall
  int cut = -1;               ///< the cut that kind, s and depth_fraction refer to
  double depth = 0;           ///< below the skin, at rest
  /// The vertices between or below which it was made; -1: a vertex of the input.
  std::array<int, 3> parents{-1, -1, -1};
};

/// A triangle of the left wall with its twin of the right one; its corners 0, 1, 2 are the twin's 0, 2, 1.
struct CutSheet {
  int left, right;
  int cut;
  std::array<double, 3> s, depth_fraction;  ///< of the left triangle's corners, for its own cut
};

/// Undone changes: what was added, and the values that changed, newest first.
struct UndoneChanges {
  std::vector<CutTriangle> triangles;
  std::vector<CutVertex> vertices;
  std::vector<CutSheet> sheets;
  std::vector<std::pair<int, CutTriangle>> triangle_log;
  std::vector<std::pair<int, CutVertex>> vertex_log;
  std::vector<std::pair<int, CutSheet>> sheet_log;
};

}  // namespace cleft
