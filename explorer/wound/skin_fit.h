// The skin's normal and curvature at places of a path, from the vertices around. Inside explorer/wound only.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "explorer/incision/incision.h"

namespace cleft {

/// Of the skin as it was given: vertices that cuts and refinement have added do not count, and those that
/// cuts have moved count where they were. Lengths in mm, `s` in mm along the path.
class SkinFit {
 public:
  /// Knows the skin beside the path from one place to another. `scale`: mm per mesh unit.
  SkinFit(const Incision& incision, double scale, double from, double to);

  /// The mean normal of the triangles under the path, within `distance`; the blade's direction where there
  /// are none.
  Vec3 mean_normal(double s, double distance) const;

  struct Shape {
    Vec3 outward;  ///< unit, the normal
    double uu, vv,
        uv;  ///< 1/mm, curvature tensor along `along` and across it; positive where the skin bulges
    /// mm: how far the vertices are from the quadric, root of the mean square; where the distance had to
    /// grow, in proportion less.
    double uneven = 0;
  };
  /// Of a quadric through the vertices within `distance`, at most four times as much where they are too few.
  /// `outward`: about the normal. None where there are not enough vertices.
  std::optional<Shape> at(double s, const Vec3& outward, const Vec3& along, double distance);

 private:
  std::vector<Vec3> vertices(const Vec3& center, const Vec3& outward, int seed, double distance);
  int triangle_at(double s, const Vec3& center, double distance) const;

  const Incision& incision_;
  const CutMesh& mesh_;
  double scale_;
  std::vector<std::pair<double, int>> beside_;  // vertices by the path's place next to them, mm
  std::vector<int> passed_, seen_;              // of triangles and vertices: the last search that came by
  int searches_ = 0;
};

}  // namespace cleft
