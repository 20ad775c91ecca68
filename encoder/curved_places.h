// The places beside a curved cut at which a node is seen from other parts of the cut than the nearest.
#pragma once

#include <vector>

#include "base/vec3.h"
#include "params/cut_curve.h"

namespace cleft {

/// In the plane of the skin a curved cut and the straight lines that continue it have, at each place u along
/// them, a normal on which v is the distance. On the inner side of a bend normals meet, and a node there is
/// on several of them. The coordinates of a node are those of the nearest one. `place` is (u, v, w) in mm by
/// them; returns all further ones, which are farther from the cut, on the same side of it. With them the
/// displacement over (u, v) is known, and smooth, where the nearest places leave a gap: beyond the centre of
/// the circle that the cut bends about.
std::vector<Vec3> further_places(const CutCurve& cut, const Vec3& place);

}  // namespace cleft
