// How the skin lies about a path before it is cut: what the incision parametrisation volume needs of the
// surface. It is found once, before the blade begins, so that no step of the cut changes it.
#pragma once

#include <vector>

#include "explorer/incision/cut_mesh.h"
#include "explorer/incision/scalpel_path.h"

namespace cleft {

/// Lengths in the mesh's units.
class Surroundings {
 public:
  Surroundings() = default;  ///< of nothing: no vertex is reached

  /// Follows the path's trace over the skin from one of `seeds`, triangles at the path's start, and from
  /// there the skin beside it and `reach` beyond its ends, as far as `reach` over the surface. Wounds that
  /// are there already are closed at rest: they are no obstacle.
  Surroundings(const CutMesh& mesh, const ScalpelPath& path, const std::vector<int>& seeds, double reach);

  /// For a blade whose way is found as it goes: the path, until `from` as it was, leads elsewhere from there,
  /// and passes the triangle `seed` next. What lies beside the path from there to
  /// `from` + `ahead` is found again, and nothing else is looked at.
  void lead_on(const CutMesh& mesh, const ScalpelPath& path, double from, double ahead, int seed);

  /// Where the path's trace passes a triangle: a piece of it, about s.
  struct Station {
    double s, length;  ///< its middle, and how long it is along the path
    double height;     ///< of the skin over C(s)
    Vec3 normal;       ///< unit, of the skin
  };
  const std::vector<Station>& stations() const { return stations_; }  ///< s increases

  /// How a vertex lies beside the path. The way over the surface, measured across the path, is its straight
  /// distance |v| and `detour`.
  struct Label {
    double detour = 0;
    float s = 0;             ///< of the path's place beside it
    Side side = Side::both;  ///< from which it is reached; both: it lies in the blade's way
    bool reached = false;
  };
  /// Of the vertices that were there before the cut, or when the path was led on.
  const std::vector<Label>& labels() const { return labels_; }
  /// The vertices whose labels the last lead_on() has made or taken away: each once, sorted.
  const std::vector<int>& relabelled() const { return relabelled_; }
  /// The label of a vertex that came later: the mean of those it was made between.
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
