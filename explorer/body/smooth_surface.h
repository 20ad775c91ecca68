// The smooth surface that the triangles of a mesh stand for.
#pragma once

#include <vector>

#include "explorer/body/surface_index.h"

namespace cleft {

/// Curved PN triangles (Vlachos et al. 2001): a cubic patch over each triangle, through its corners and
/// square to their normals, which are means of those of its triangles. Skin under tension presses where it is
/// bent, so that elements smaller than the triangles of a mesh would feel each of its edges as a fold. A
/// corner from whose normal a triangle's differs by more than 30 degrees is a feature: edges leave it
/// straight.
class SmoothSurface {
 public:
  /// Keeps the mesh, of which the triangles within the box of `places` and next to it are enough.
  SmoothSurface(const SurfaceMesh& mesh, const std::vector<Vec3>& places);

  /// Where the place of the mesh nearest to `x` is on it.
  Vec3 nearest(const Vec3& x) const;

 private:
  std::vector<Vec3> normals_;  // of the mesh's points; 0 at features
  SurfaceIndex part_;
};

}  // namespace cleft
