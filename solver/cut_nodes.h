// The nodes of the cut, with their own numbers.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "solver/patch_mesh.h"
#include "solver/patch_system.h"

namespace cleft {

/// The displacements of a pair's nodes are u_left and u_right = u_left + a: with the jumps a instead of
/// u_right, u = T x. A closed pair has a = 0.
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

  /// T: jumps, in the rows of right nodes, to displacements. Columns of vectors of these nodes.
  void to_displacements(Eigen::MatrixXd& x) const {
    for (const auto& [left, right] : pairs) x.middleRows<3>(3 * right) += x.middleRows<3>(3 * left);
  }
  /// T^T: from forces on the nodes to forces on pairs and on jumps.
  void to_pulls(Eigen::MatrixXd& f) const {
    for (auto pair = pairs.rbegin(); pair != pairs.rend(); ++pair)
      f.middleRows<3>(3 * (*pair)[0]) += f.middleRows<3>(3 * (*pair)[1]);
  }

  std::vector<int> nodes;     ///< of the mesh, each once
  std::vector<int> unknowns;  ///< three for each node
  std::vector<std::array<int, 2>>
      pairs;  ///< left and right node of the mesh's pairs, as indices into `nodes`
};

}  // namespace cleft
