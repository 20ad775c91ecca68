// Coordinates about the path, for a mesh that is far from the origin: there coordinates are rounded more
// coarsely than the tolerances of a cut allow for.
#pragma once

#include "explorer/incision/scalpel_path.h"
#include "explorer/incision/surface_mesh.h"

namespace cleft {

/// The origin from which a mesh should be cut along a path, in the mesh's units: where the path begins, if
/// the mesh is more than a thousand times its diameter away from the origin, else the origin itself.
Vec3 local_origin(const SurfaceMesh& mesh, const ScalpelPath& path);

/// The mesh with all points moved. Moving by -local_origin() is exact: the differences of coordinates have
/// no more digits than these.
SurfaceMesh moved(SurfaceMesh mesh, const Vec3& by);

}  // namespace cleft
