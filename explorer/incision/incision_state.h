// The state that the parts of a growing cut share: the mesh, the path, lengths, and the progress of the cut.
// incision_places decides where vertices of the path are put, incision_walk how the path continues,
// incision_change changes the mesh, incision_advance repeats these up to the position of the blade. Inside
// explorer/incision only.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "explorer/incision/incision.h"
#include "explorer/incision/incision_tolerances.h"
#include "explorer/incision/walls.h"

namespace cleft {

/// The continuation of the path from the last vertex of the chain.
struct PathStep {
  enum Kind { vertex, edge, face } kind;
  int triangle;  ///< edge, face
  int index;     ///< the vertex, or the number of the edge
  Vec3 place;
  double s;
  bool inside = false;  ///< not where the path crosses an edge, but between two such places
};

/// Where the piece of the path between two wounds that the tip is in begins.
enum class PathEnd { closed, boundary, wound };

/// The state before the next step of a cut, which is restored when a step is undone.
struct IncisionTip {
  PathEnd start = PathEnd::closed;
  std::size_t piece = 0;         ///< the first vertex of the path's piece between two wounds, in the chain
  bool pending = false;          ///< the piece's first segment is not sewn in yet: both its ends are closed
  bool arrived = false;          ///< the tip's vertex is on a wound
  int from = -1;                 ///< where the path continues from that wound
  std::optional<Column> column;  ///< below the tip
  std::vector<int> below;        ///< below the wound where the path came to it
  /// Triangles that remained below the least ratio, and the number of attempts: a step next to them may make
  /// a repair possible.
  std::vector<std::pair<int, int>> poor;
  int bisections = 0;  ///< that have made room for the next vertex
  bool left_mesh = false;
};

/// Lengths in the mesh's units.
struct IncisionState {
  /// `number` is that of the cut in its mesh.
  IncisionState(CutMesh& mesh, ScalpelPath path, int number, const IncisionOptions& options);

  CutMesh& mesh;
  ScalpelPath path;
  int number;
  double snap;  ///< IncisionOptions::snap
  double chord_tolerance, longest_piece;
  double worst_before;  ///< smallest radius ratio of the skin before the cut
  double least_ratio;   ///< radius ratio that triangles made by the cut should reach
  int rows = static_cast<int>(IncisionTolerances::fewest_rows);  ///< of triangles in the walls
  bool bent = false;                                             ///< see Incision::bent()
  std::vector<Incision::ChainVertex> chain;                      ///< see Incision::chain()
  IncisionTip tip;
  std::optional<PathStep> next;  ///< found already, not made yet

  double tip_s() const { return chain.back().s; }
  /// The vertex from which the path continues: the chain's last, or behind a wound that of the opposite lip.
  int tip_vertex() const { return tip.from >= 0 ? tip.from : chain.back().left; }
  /// From the skin to the bottom of the cut.
  Vec3 down(double s) const { return -path.depth(s) * path.at(s).outward; }

  /// Data for undoing steps.
  struct Before {
    CutMesh::Checkpoint mesh;
    std::size_t chain;
    std::vector<Incision::ChainVertex> last;
    IncisionTip tip;
  };
  Before before() const;
  void roll_back(const Before& to);

  /// The vertex at the tip is provisional: it is undone before the blade continues, so that the places where
  /// the blade stopped leave no trace.
  std::optional<Before> provisional;
  void drop_provisional();
};

}  // namespace cleft
