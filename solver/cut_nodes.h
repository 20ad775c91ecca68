// The nodes of the cut, numbered by themselves.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "solver/patch_mesh.h"
#include "solver/patch_system.h"

namespace cleft {

struct CutNodes {
  CutNodes(const PatchMesh& mesh, const PatchSystem& system) {
    for (const NodePair& pair : mesh.pairs) nodes.insert(nodes.end(), {pair.left, pair.right});
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    for (const NodePair& pair : mesh.pairs) pairs.push_back({place(pair.left), place(pair.right)});
    for (const int node : nodes)
      for (int axis = 0; axis < 3; ++axis) unknowns.push_back(system.unknown(node, axis));
  }

  int place(int node) const {
    return static_cast<int>(std::lower_bound(nodes.begin(), nodes.end(), node) - nodes.begin());
  }

  std::vector<int> nodes;                 ///< of the mesh, each once
  std::vector<int> unknowns;              ///< three a node
  std::vector<std::array<int, 2>> pairs;  ///< left and right of the mesh's pairs, as places in `nodes`
};

}  // namespace cleft
