#include "solver/elimination_order.h"

#include <metis.h>

#include <algorithm>
#include <stdexcept>

namespace cleft {

namespace {

/// Neighbours of the nodes that share a wedge, among those not in a pair; numbered without the pairs.
struct NodeGraph {
  std::vector<idx_t> first, neighbors;
  std::vector<int> node;  // by number

  explicit NodeGraph(const PatchMesh& mesh) {
    std::vector<int> number(mesh.points.size(), 0);
    for (const NodePair& pair : mesh.pairs) number[pair.left] = number[pair.right] = -1;
    for (std::size_t n = 0; n < number.size(); ++n)
      if (number[n] == 0) {
        number[n] = static_cast<int>(node.size());
        node.push_back(static_cast<int>(n));
      }
    std::vector<std::vector<idx_t>> lists(node.size());
    for (const auto& wedge : mesh.wedges)
      for (const int a : wedge)
        for (const int b : wedge)
          if (a != b && number[a] >= 0 && number[b] >= 0) lists[number[a]].push_back(number[b]);
    first.push_back(0);
    for (auto& list : lists) {
      std::sort(list.begin(), list.end());
      list.erase(std::unique(list.begin(), list.end()), list.end());
      neighbors.insert(neighbors.end(), list.begin(), list.end());
      first.push_back(static_cast<idx_t>(neighbors.size()));
    }
  }
};

}  // namespace

std::vector<int> elimination_order(const PatchMesh& mesh, const PatchSystem& system,
                                   const std::vector<int>& kept) {
  NodeGraph graph(mesh);
  idx_t count = static_cast<idx_t>(graph.node.size());
  std::vector<idx_t> old_of(graph.node.size()), new_of(graph.node.size());
  if (METIS_NodeND(&count, graph.first.data(), graph.neighbors.data(), nullptr, nullptr, old_of.data(),
                   new_of.data()) != METIS_OK)
    throw std::runtime_error("ordering the unknowns failed: METIS ran out of memory");
  std::vector<int> position(system.size());
  for (std::size_t i = 0; i < graph.node.size(); ++i)
    for (int axis = 0; axis < 3; ++axis)
      position[system.unknown(graph.node[i], axis)] = 3 * static_cast<int>(new_of[i]) + axis;
  int next = 3 * static_cast<int>(count);
  for (const int unknown : kept) position[unknown] = next++;
  return position;
}

}  // namespace cleft
