// The shape of a cut's surroundings from place to place: how the path curves in the skin, how the blade is
// tilted, how deep it is, and how the skin is curved. A family of fields is evaluated with it.
//
// All of it is of the skin before the cut, at rest, whatever has been cut since. A path is first unrolled
// into a plane, so that its curvature there is the geodesic one: a great circle of a sphere is straight.
#pragma once

#include <functional>
#include <limits>
#include <vector>

#include "explorer/incision/incision.h"

namespace cleft {

/// At a place of a path, in its frame: along, across = outward x along. Lengths in mm, angles in degrees.
struct LocalShape {
  double curvature = 0;       ///< 1/mm, of the path in the skin; positive: it curves toward +v, across
  double curvature_rate = 0;  ///< 1/mm^2: by how much the curvature grows for each mm along the path
  double tilt = 0;            ///< of the blade against the skin's normal; positive: the bottom is toward +v
  double depth = 0;           ///< of the blade, along itself
  double tissue = std::numeric_limits<double>::infinity();  ///< mm, above bone, if there is any below
  /// 1/mm, the curvature tensor of the skin; positive where the body bulges: 1/R, 1/R, 0 of a sphere.
  double skin_u = 0, skin_v = 0, skin_uv = 0;
  double skin_uneven = 0;  ///< mm: how far the skin is from a quadric, root of the mean square
  Vec3 along = {};         ///< unit, in space: the path's smooth direction, in which all of this is
  Vec3 outward = {};       ///< unit: the skin's normal
};

/// The shape of all of a path.
struct PathShape {
  std::vector<double> stations;  ///< mm along the path, increasing
  std::vector<LocalShape> values;

  /// Linear between the stations, and as at the ends beyond them. There must be a station.
  LocalShape at(double s) const;
};

/// How thick the tissue is above bone: mm from a place, in the space of the mesh but in mm, in a direction;
/// infinite where there is no bone.
using TissueAboveBone = std::function<double(const Vec3& place, const Vec3& inward)>;

/// The mean of that next to a place of the skin, over `reach` mm along the cut and less across it, of at most
/// `whole` mm each; infinite where all are as thick.
double mean_tissue(const TissueAboveBone& tissue, const Vec3& place, const LocalShape& at, double reach,
                   double whole);

/// The scales below which shape is noise, mm, above 0: of the path's curvature and direction, and of the
/// skin.
struct Smoothing {
  double path, skin;
};

/// `scale` is mm per mesh unit, `s` mm along the path, clamped to it. Points of the path, and vertices of the
/// skin, within the distances of the smoothing are fitted, with weights that fall to 0 there; next to the
/// path's ends points as far as twice the distance on the one side. Where there are too few, the distance
/// grows. Of a path much shorter than its smoothing no curvature is known, it is nearly 0; without enough
/// vertices around, up to four times the distance, the skin's is 0. Throws InputError if the smoothing or the
/// scale is not above 0, or infinite.
LocalShape local_shape(const Incision& incision, double scale, double s, const Smoothing& smoothing);

/// The same at even distances of a quarter of the skin's smoothing or less, from 0 to the end of the path; of
/// a path that is found as the blade moves, to where it has come.
PathShape shape_along(const Incision& incision, double scale, const Smoothing& smoothing);

}  // namespace cleft
