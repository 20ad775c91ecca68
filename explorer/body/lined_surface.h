// The skin about cuts that will be made, whole, with edges along all of them.
#pragma once

#include <vector>

#include "explorer/incision/scalpel_path.h"
#include "explorer/incision/surface_mesh.h"

namespace cleft {

/// An edge of the surface along a cut.
struct CutLine {
  int from, to;         ///< points, in the direction of the path
  double s_from, s_to;  ///< arc length of the path there
};

/// Lengths in mm.
struct LinedSurface {
  SurfaceMesh mesh;
  std::vector<std::vector<CutLine>> cuts;  ///< by path, s increases
  std::vector<bool> outline;               ///< by point: whether the whole mesh ends there
};

/// Cuts the mesh along all paths, closes the cuts again, and takes the part within `reach` of them, measured
/// along edges. Throws InputError, as cuts do, naming the cut.
LinedSurface lined_surface(const SurfaceMesh& mesh, const std::vector<ScalpelPath>& paths, double reach);

/// The surface without some of its triangles, and without points that only these had. The body goes on at the
/// edges of what was taken out.
LinedSurface without(const LinedSurface& surface, const std::vector<bool>& taken_out);

/// Divides each stretch of the cuts between their ends and crossings into equal parts of at most `size`, and
/// makes a point of the surface at each of their ends. Returns, by point, whether it is such an end.
std::vector<bool> place_stations(LinedSurface& surface, double size);

}  // namespace cleft
