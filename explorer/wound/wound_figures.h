// How large the wounds in a mesh are.
#pragma once

#include <memory>
#include <vector>

#include "explorer/incision/incision.h"

namespace cleft {

/// Of one cut; lengths in mm.
struct WoundFigures {
  double length = 0;                 ///< of its path
  double depth = 0;                  ///< of its blade, at most
  double widest = 0, widest_at = 0;  ///< distance from lip to lip, and where along the path
  double area = 0;                   ///< mm^2: the opening, integrated over the path
  double volume = 0;                 ///< mm^3: between its walls
};

/// Of each cut in the mesh, whose vertices are at `moved`.
std::vector<WoundFigures> wound_figures(const CutMesh& mesh,
                                        const std::vector<std::unique_ptr<Incision>>& cuts,
                                        const std::vector<Vec3>& moved);

}  // namespace cleft
