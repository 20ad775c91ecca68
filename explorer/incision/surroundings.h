// The skin around a path before it is cut: the data of the surface for the incision parametrisation volume.
// They are computed once, before the blade starts, so that no step of the cut changes them.
#pragma once

#include <vector>

#include "explorer/incision/cut_mesh.h"
#include "explorer/incision/scalpel_path.h"

namespace cleft {

/// Lengths in the mesh's units.
class Surroundings {
 public:
  Surroundings() = default;  ///< of nothing: no vertex is reached

  /// Follows the path's trace over the skin from one of `seeds`, triangles at the path's start, and searches
  /// the skin next to it and beyond its ends up to `reach` over the surface. Existing wounds are closed at
  /// rest and no obstacle.
  Surroundings(const CutMesh& mesh, const ScalpelPath& path, const std::vector<int>& seeds, double reach);

  /// For a path that is not known in advance: the path has changed from `from` on, and passes the triangle
  /// `seed` there. Searches again the skin next to the path from `from` to `from` + `ahead`, and nothing
  /// else.
  void extend(const CutMesh& mesh, const ScalpelPath& path, double from, double ahead, int seed);

  /// A piece of the path's trace, in one triangle, around s.
  struct Station {
    double s, length;  ///< its middle, and its length along the path
    double height;     ///< of the skin over C(s)
    Vec3 normal;       ///< unit, of the skin
  };
  const std::vector<Station>& stations() const { return stations_; }  ///< s increases

  /// The position of a vertex relative to the path. Its distance over the surface, measured across the path,
  /// is the straight distance |v| plus `detour`.
  struct Label {
    double detour = 0;
    float s = 0;             ///< of the nearest place of the path
    Side side = Side::both;  ///< from which it is reached; both: it is on the path of the blade
    bool reached = false;
  };
  /// Labels of the vertices that existed before the cut, or when the path was extended.
  const std::vector<Label>& labels() const { return labels_; }
  /// The vertices whose labels the last extension of the path has made or removed: each once, sorted.
  const std::vector<int>& relabelled() const { return relabelled_; }
  /// The label of a later vertex: the mean of those of its parents.
  static Label of_parents(const CutMesh& mesh, int vertex, const std::vector<Label>& labels);
  double reach() const { return reach_; }

 private:
  class Front;
  void keep_until(double from);

  std::vector<Station> stations_;
  std::vector<Label> labels_;
  std::vector<int> reached_, relabelled_;  // by the last search; see relabelled()
  double reach_ = 0;
};

}  // namespace cleft
