#include "solver/elimination_order.h"

#include <algorithm>
#include <array>

#include "base/error.h"

namespace cleft {

namespace {

/// Nested dissection of the grid under the closed mesh: a box is cut across its longest side by a plane of
/// nodes, which comes after the two halves.
class Dissection {
 public:
  explicit Dissection(const std::array<int, 3>& grid) : grid_(grid) {
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
    if (length <= smallest) {
      append(from, to);
      return;
    }
    const int middle = from[axis] + length / 2;
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
  std::vector<int> order_;
};

}  // namespace

std::vector<int> elimination_order(const PatchMesh& mesh, const PatchSystem& system,
                                   const std::vector<int>& kept) {
  std::vector<int> position(static_cast<std::size_t>(system.size()));
  int next = 0;
  const Dissection dissection(mesh.grid);
  for (const int node : dissection.order())
    for (int axis = 0; axis < 3; ++axis) position[system.unknown(node, axis)] = next++;
  for (const int unknown : kept) position[unknown] = next++;
  CLEFT_CHECK(next, ==, system.size());
  return position;
}

}  // namespace cleft
