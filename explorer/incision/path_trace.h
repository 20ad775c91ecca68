// The way of a path over the skin: the triangles that it passes, and on which side of it their corners are.
#pragma once

#include <optional>
#include <unordered_set>
#include <vector>

#include "explorer/incision/cut_mesh.h"
#include "explorer/incision/scalpel_path.h"

namespace cleft {

/// The skin triangle across edge i of t; beyond a wound, that at the opposite lip; -1: there is none.
int skin_across(const CutMesh& mesh, int t, int i);

/// The zero of v on the surface, from triangle to triangle. Beyond the path's ends, where it goes straight
/// on, only as far as the end is the nearest place of the whole path: a loop's end does not lead over its
/// start. Lengths in the mesh's units.
class PathTrace {
 public:
  /// Between these places of the path.
  PathTrace(const CutMesh& mesh, const ScalpelPath& path, double first, double last)
      : mesh_(mesh), path_(path), first_(first), last_(last) {}

  /// From triangle t on, where the path passes it near s, ahead or back. False where it does not pass.
  bool follow(int t, double s, bool ahead);

  /// From triangle t on, under places of the path between 0 and its length, to the triangles that follow()
  /// has not passed: it ends where a path turns back within a triangle, or leaves it as it came.
  void cover(int t);

  /// The part of the path in one triangle, around s.
  struct Piece {
    double s, length;  ///< its middle, and its length along the path
    double height;     ///< of the skin over C(s)
    Vec3 normal;       ///< unit, of the skin
  };
  std::vector<Piece> pieces;

  /// A corner of a triangle. It is looked for near a known place of the path: one that comes back to where
  /// it was before is still followed.
  struct Corner {
    int vertex = -1;
    PathCoordinates at;
    bool right() const { return at.v >= 0; }
  };
  std::vector<Corner> corners;  ///< of all triangles passed

 private:
  /// Where the path leaves a triangle.
  struct Exit {
    int edge;
    double s, longest_edge;
    Vec3 place;
  };
  bool leads_over_path(const Exit& exit) const;
  std::optional<Exit> pass(int t, int from, double s, bool ahead);
  Corner corner_at(int vertex, double s, double reach) const;
  int under(int t, const PathFrame& place) const;

  const CutMesh& mesh_;
  const ScalpelPath& path_;
  double first_, last_;
  std::unordered_set<int> passed_;
};

}  // namespace cleft
