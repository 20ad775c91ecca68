// A volume mesh of one's own as columns of wedges below its skin, and the walls of its cuts.
#pragma once

#include <array>
#include <set>
#include <string>
#include <vector>

#include "base/vec3.h"

namespace cleft {

/// The cells of a file.
struct OwnMesh {
  std::string name;  ///< of the file, for messages
  std::vector<Vec3> points;
  std::vector<int> types;               ///< VTK's number of each cell's type
  std::vector<std::vector<int>> nodes;  ///< of each cell
  std::vector<int> regions;             ///< by cell; empty: not numbered
};

/// Which of a mesh's triangles and quads are what, by the numbers of their regions.
struct OwnFaces {
  bool all_skin = true;  ///< all triangles are the skin; all quads where there are no triangles
  std::set<int> skin, bone, free;
};

/// A face of two columns that touch without having its nodes in common.
struct OwnWall {
  std::array<int, 2> column;
  std::array<int, 2> edge;  ///< of each column's triangle of skin: from this corner to the next
  int layer;                ///< from the skin
};

/// Nodes are those of the mesh; those at one place, the copies of a cut, have exactly one position.
struct OwnColumns {
  std::vector<Vec3> points;
  std::vector<int> place;                               ///< by node: the first node at its place
  std::vector<std::array<int, 3>> skin;                 ///< by column; counter-clockwise from outside
  std::vector<std::vector<std::array<int, 6>>> wedges;  ///< by column, from the skin down: lower, upper
  std::vector<std::vector<int>> cells;                  ///< by column: numbers in the mesh
  std::vector<int> above;                               ///< by node: the one above it; -1: it is of the skin
  std::vector<double> depth;                            ///< by node, mm below the skin along its column
  std::vector<OwnWall> walls;
  std::vector<std::array<int, 4>> sides;   ///< other faces beside which there is no column; cyclic
  std::vector<std::array<int, 3>> bottom;  ///< by column
  std::vector<bool> on_bone;               ///< by column
};

/// Wedges, and hexahedra, each of which becomes two wedges, in columns that go down from each face of the
/// skin; columns may have different numbers of layers. Throws FileError, which names the cell or node, its
/// place and the remedy, for other cells, cells that are turned inside out or do not hang from the skin, and
/// walls whose nodes nearly coincide.
OwnColumns columns_of(const OwnMesh& mesh, const OwnFaces& faces);

}  // namespace cleft
