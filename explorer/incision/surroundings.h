// The skin around a path before it is cut: the data of the surface for the incision parametrisation volume.
// They are computed once, before the blade starts, so that no step of the cut changes them.
#pragma once

#include <vector>

#include "explorer/incision/cut_mesh.h"
#include "explorer/incision/path_trace.h"
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
  /// else. `cut`: the number of the path's own cut in the mesh.
  void extend(const CutMesh& mesh, const ScalpelPath& path, double from, double ahead, int seed, int cut);

  /// For a path that was extended, ends in the mesh at `from`, and is known now: searches all of its skin
  /// again. `cut` is its number in the mesh, where it has been cut, and `seed` as above.
  void search_again(const CutMesh& mesh, const ScalpelPath& path, double from, int seed, int cut);

  using Station = PathTrace::Piece;
  const std::vector<Station>& stations() const { return stations_; }  ///< s increases

  /// A vertex whose coordinates differ from those of a neighbour by much more than their distance: inside
  /// bends, where the path comes back, beside folds.
  struct Irregular {
    Vec3 position;
    double s, across;  ///< its coordinates
    double times;      ///< how much further apart they are
    Side side;         ///< of the path; both: it counts for both
    double steady;     ///< ScalpelPath::steady_place of it
    struct Neighbour {
      double steady, across, distance;
    } neighbour;  ///< that whose coordinates are so much further apart
  };
  const std::vector<Irregular>& irregular() const { return irregular_; }

  /// The position of a vertex relative to the path. Its distance over the surface, measured across the path,
  /// is the straight distance |v| plus `detour`.
  struct Label {
    double detour = 0;
    float s = 0;             ///< of the nearest place of the path
    Side side = Side::both;  ///< from which it is reached; both: it is on the path of the blade
    bool reached = false;
    bool operator==(const Label&) const = default;
  };
  /// Labels of the vertices that existed before the cut, or when the path was extended.
  const std::vector<Label>& labels() const { return labels_; }
  /// The vertices whose labels the last extension of the path has made or removed: each once, sorted.
  const std::vector<int>& relabelled() const { return relabelled_; }
  /// The label of a later vertex: the mean of those of its parents.
  static Label of_parents(const CutMesh& mesh, int vertex, const std::vector<Label>& labels);
  /// The signed distance from the path, measured across it over the surface. `straight` is v of the place's
  /// PathCoordinates: between the curve and its chords, and where the curve is as far on both sides, its sign
  /// may be another than the side's.
  static double across(double straight, double detour, Side side);
  double reach() const { return reach_; }

 private:
  class Front;
  void keep_until(double from);
  std::vector<PathTrace::Corner> trace_on(const CutMesh& mesh, const ScalpelPath& path, double from,
                                          double ahead, int seed);
  void add_stations(std::vector<Station> stations);
  void label_walls(const CutMesh& mesh);

  std::vector<Station> stations_;
  std::vector<Irregular> irregular_;
  std::vector<Label> labels_;
  std::vector<int> reached_, relabelled_;  // by the last search; see relabelled()
  std::vector<int> walls_;                 // vertices of earlier cuts below their lips
  std::vector<int> before_start_;          // vertices next to the path straight on before its start
  double reach_ = 0;
};

}  // namespace cleft
