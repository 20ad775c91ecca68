// A surface mesh with all its cuts, made one after another.
#pragma once

#include <memory>
#include <vector>

#include "explorer/incision/incision.h"

namespace cleft {

/// Immutable: adding or undoing a cut makes a new object.
class CutSurface {
 public:
  /// Cuts along all paths to their ends; lengths in mm. Throws InputError naming the cut if a path does not
  /// meet the mesh or cannot continue.
  CutSurface(const SurfaceMesh& mesh, const std::vector<ScalpelPath>& paths);

  const CutMesh& mesh() const { return mesh_; }
  const std::vector<std::unique_ptr<Incision>>& cuts() const { return cuts_; }
  int original_points() const { return original_points_; }
  /// The mesh's own, carried to each vertex (PlacesBefore); empty where it has none.
  const std::vector<PointColor>& colors() const { return colors_; }

 private:
  CutMesh mesh_;
  int original_points_;
  std::vector<std::unique_ptr<Incision>> cuts_;
  std::vector<PointColor> colors_;
};

}  // namespace cleft
