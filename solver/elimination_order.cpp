#include "solver/elimination_order.h"

#include <metis.h>

#include <algorithm>
#include <array>
#include <numeric>

#include "base/error.h"

namespace cleft {

namespace {

/// Nested dissection of the grid under the closed mesh: a box is cut across its longest side by a plane of
/// nodes between elements, which comes after the two halves.
class Dissection {
 public:
  /// `lines`: from an element's line of nodes to the next.
  Dissection(const std::array<int, 3>& grid, int lines) : grid_(grid), lines_(lines) {
    order_.reserve(static_cast<std::size_t>(grid[0]) * grid[1] * grid[2]);
    dissect({0, 0, 0}, grid);
  }

  const std::vector<int>& order() const { return order_; }  ///< node after node

 private:
  using Corner = std::array<int, 3>;

  void dissect(const Corner& from, const Corner& to) {
    int axis = 0;
    for (const int a : {1, 2})
      if (to[a] - from[a] > to[axis] - from[axis]) axis = a;
    const int length = to[axis] - from[axis];
    if (length <= smallest * lines_) {
      append(from, to);
      return;
    }
    const int middle = (from[axis] + length / 2) / lines_ * lines_;
    Corner before = to, after = from, plane_from = from, plane_to = to;
    before[axis] = plane_from[axis] = middle;
    after[axis] = plane_to[axis] = middle + 1;
    dissect(from, before);
    dissect(after, to);
    append(plane_from, plane_to);
  }

  void append(const Corner& from, const Corner& to) {
    for (int k = from[2]; k < to[2]; ++k)
      for (int j = from[1]; j < to[1]; ++j)
        for (int i = from[0]; i < to[0]; ++i) order_.push_back((k * grid_[1] + j) * grid_[0] + i);
  }

  static constexpr int smallest = 3;  // boxes of so many nodes a side are not divided further
  Corner grid_;
  int lines_;
  std::vector<int> order_;
};

/// A body has no grid: METIS divides the graph of its closed mesh, whose nodes are neighbours within a wedge.
/// (Halves of equal numbers of columns, across the longest side, took 2.5 times the operations.)
std::vector<int> dissected_body(const PatchMesh& mesh) {
  const std::size_t nodes = mesh.points.size();
  std::vector<int> root(nodes);
  std::iota(root.begin(), root.end(), 0);
  for (const NodePair& pair : mesh.pairs) root[pair.right] = pair.left;
  const auto root_of = [&](int node) {
    while (root[node] != node) node = root[node];
    return node;
  };
  std::vector<int> closed;           // the nodes of the closed mesh
  std::vector<idx_t> number(nodes);  // of a node of the mesh among them
  for (std::size_t n = 0; n < nodes; ++n)
    if (root[n] == static_cast<int>(n)) {
      number[n] = static_cast<idx_t>(closed.size());
      closed.push_back(static_cast<int>(n));
    }
  std::vector<std::vector<idx_t>> neighbours(closed.size());
  for (const auto& wedge : mesh.wedges)
    for (const int a : wedge)
      for (const int b : wedge) {
        const idx_t from = number[root_of(a)], to = number[root_of(b)];
        if (from != to) neighbours[from].push_back(to);
      }
  std::vector<idx_t> starts = {0}, all;
  for (auto& list : neighbours) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
    all.insert(all.end(), list.begin(), list.end());
    starts.push_back(static_cast<idx_t>(all.size()));
  }
  auto count = static_cast<idx_t>(closed.size());
  std::vector<idx_t> order(closed.size()), position(closed.size());
  const int outcome =
      METIS_NodeND(&count, starts.data(), all.data(), nullptr, nullptr, order.data(), position.data());
  CLEFT_CHECK(outcome, ==, METIS_OK);
  std::vector<int> result(closed.size());
  std::transform(order.begin(), order.end(), result.begin(), [&](idx_t n) { return closed[n]; });
  return result;
}

std::vector<int> dissected(const PatchMesh& mesh) {
  return mesh.is_body() ? dissected_body(mesh) : Dissection(mesh.grid, mesh.lines_of_element()).order();
}

}  // namespace

std::vector<int> elimination_order(const PatchMesh& mesh, const PatchSystem& system,
                                   const std::vector<int>& kept) {
  std::vector<int> position(static_cast<std::size_t>(system.size()));
  int next = 0;
  for (const int node : dissected(mesh))
    for (int axis = 0; axis < 3; ++axis) position[system.unknown(node, axis)] = next++;
  for (const int unknown : kept) position[unknown] = next++;
  CLEFT_CHECK(next, ==, system.size());
  return position;
}

}  // namespace cleft
