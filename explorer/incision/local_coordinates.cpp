#include "explorer/incision/local_coordinates.h"

#include <algorithm>
#include <utility>

#include "explorer/incision/incision_tolerances.h"

namespace cleft {

Vec3 local_origin(const SurfaceMesh& mesh, const ScalpelPath& path) {
  if (mesh.points.empty()) return {};
  Vec3 low = mesh.points[0], high = low;
  for (const Vec3& p : mesh.points)
    for (int k = 0; k < 3; ++k) low[k] = std::min(low[k], p[k]), high[k] = std::max(high[k], p[k]);
  const Vec3 middle = low + 0.5 * (high - low);
  if (norm(middle) <= IncisionTolerances::far_diameters * norm(high - low)) return {};
  return path.at(0).position;
}

SurfaceMesh moved(SurfaceMesh mesh, const Vec3& by) {
  if (by == Vec3{}) return mesh;  // not even the sign of a zero changes
  for (Vec3& p : mesh.points) p += by;
  return mesh;
}

}  // namespace cleft
