// The skin of a simulated patch as a surface to cut.
#pragma once

#include <vector>

#include "explorer/incision/surface_mesh.h"
#include "solver/snapshot/snapshot.h"

namespace cleft {

/// The skin at its stress-free positions, without the cut: left and right nodes are one vertex.
struct UncutSkin {
  SurfaceMesh mesh;
  std::vector<int> node_of;  ///< of each vertex: its node, the left one of pairs
};
UncutSkin uncut_skin(const Snapshot& snapshot);

}  // namespace cleft
