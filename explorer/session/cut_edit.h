// The path of a cut that was made already, changed: points, depth and tilt. The values of the handles in a
// picture, and of the command edit-cut.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "explorer/body/surface_index.h"
#include "explorer/session/session_state.h"

namespace cleft {

/// The uncut skin at rest, on which the points of cuts are put.
class Skin {
 public:
  explicit Skin(const SurfaceMesh& mesh);
  struct Place {
    Vec3 position, outward;  ///< outward: of length 1, varying smoothly over the triangles
  };
  Place nearest(const Vec3& x) const;
  /// Likewise, on the side of a thin part, such as an ear, whose normal is less than a right angle away from
  /// `outward`; where there is none within `reach`, the nearest of all.
  Place nearest(const Vec3& x, const Vec3& outward, double reach) const;

 private:
  Place place_of(const SurfacePlace& found) const;

  SurfaceIndex index_;
  std::vector<Vec3> normals_;  // of its points
};

struct CutEdit {
  struct Move {
    int point = 0;  ///< from 0
    Vec3 to;        ///< mm; put on the skin, from which it must be at most `farthest` away
  };
  std::vector<Move> moves;
  double reach = 0;  ///< mm along the path: points within it follow smoothly; 0: none follow
  /// Of the deepest place, mm; the others in proportion. 0: as deep as the case.
  std::optional<double> depth;
  std::optional<double> tilt;  ///< degrees from the skin's normal, to the left of the cut's direction

  static constexpr double farthest = 1, steepest = 80;  ///< mm, degrees
};

/// Moved points are on the skin, and the blade leans there against it as it did. Throws InputError if there
/// is no such point, or the skin is too far from a place.
CutState edited(const CutState& cut, const CutEdit& edit, const Skin& skin);

/// Where the handles of a cut are. Lengths in mm.
struct CutHandles {
  std::vector<int> points;  ///< that are moved: all of a few, else some that are evenly spaced, from 0
  std::vector<Vec3> places;
  double reach = 0;  ///< of a move: up to the neighbours in `points`; 0 where all are
  /// The blade at a place of the path.
  struct Blade {
    Vec3 foot, along, across, outward;  ///< outward: of the skin, of length 1
    double depth = 0, tilt = 0;         ///< mm; degrees, to the left
    Vec3 direction() const;             ///< out of the body, along the blade
  };
  Blade depth, tilt;
  double lever = 0;  ///< how far the handle of the tilt is from the foot
  Vec3 depth_handle() const { return depth.foot - depth.depth * depth.direction(); }
  Vec3 tilt_handle() const { return tilt.foot + lever * tilt.direction(); }
  std::vector<Vec3> line, edge;  ///< the path on the skin, and the lower edge of the blade
};

/// `depth`: of points that state none. Throws InputError as ScalpelPath does.
CutHandles handles_of(const CutState& cut, double depth, const Skin& skin);

}  // namespace cleft
