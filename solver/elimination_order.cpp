#include "solver/elimination_order.h"

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

/// Nested dissection of a body by the columns of nodes below its skin: a part is halved across its longest
/// side; the columns of the first half that have neighbours in the second come after both.
class ColumnDissection {
 public:
  explicit ColumnDissection(const PatchMesh& mesh) : mesh_(mesh) {
    std::vector<bool> doubled(mesh.points.size(), false);
    for (const NodePair& pair : mesh.pairs) doubled[pair.right] = true;
    root_.resize(mesh.points.size());
    std::iota(root_.begin(), root_.end(), 0);
    for (const NodePair& pair : mesh.pairs) root_[pair.right] = pair.left;
    columns_.resize(mesh.points.size()), neighbors_.resize(mesh.points.size());
    std::vector<int> all;
    for (int n = 0; n < static_cast<int>(mesh.points.size()); ++n) {
      if (doubled[n]) continue;
      const int column = root_of(mesh.skin_above[n]);
      if (columns_[column].empty()) all.push_back(column);
      columns_[column].push_back(n);
    }
    for (const auto& triangle : mesh.skin)
      for (int c = 0; c < 3; ++c)
        for (const int next : {1, 2})
          neighbors_[root_of(triangle[c])].push_back(root_of(triangle[(c + next) % 3]));
    part_.assign(mesh.points.size(), 0);
    dissect(std::move(all));
  }

  const std::vector<int>& order() const { return order_; }  ///< node after node, without the duplicates

 private:
  int root_of(int node) const {
    while (root_[node] != node) node = root_[node];
    return node;
  }

  void append(const std::vector<int>& columns) {
    for (const int column : columns)
      order_.insert(order_.end(), columns_[column].begin(), columns_[column].end());
  }

  void dissect(std::vector<int> columns) {
    if (columns.size() <= smallest) return append(columns);
    Vec3 least = mesh_.points[columns.front()], most = least;
    for (const int c : columns)
      for (int axis = 0; axis < 3; ++axis) {
        least[axis] = std::min(least[axis], mesh_.points[c][axis]);
        most[axis] = std::max(most[axis], mesh_.points[c][axis]);
      }
    int axis = 0;
    for (const int a : {1, 2})
      if (most[a] - least[a] > most[axis] - least[axis]) axis = a;
    const auto middle = columns.begin() + static_cast<std::ptrdiff_t>(columns.size() / 2);
    std::nth_element(columns.begin(), middle, columns.end(), [&](int a, int b) {
      const double x = mesh_.points[a][axis], y = mesh_.points[b][axis];
      return x != y ? x < y : a < b;
    });
    const int first = ++parts_, second = ++parts_;
    for (auto c = columns.begin(); c != columns.end(); ++c) part_[*c] = c < middle ? first : second;
    std::vector<int> before, between, after(middle, columns.end());
    for (auto c = columns.begin(); c != middle; ++c) {
      const auto& around = neighbors_[*c];
      const bool touches =
          std::any_of(around.begin(), around.end(), [&](int n) { return part_[n] == second; });
      (touches ? between : before).push_back(*c);
    }
    for (auto* list : {&before, &between, &after}) std::sort(list->begin(), list->end());
    dissect(std::move(before));
    dissect(std::move(after));
    append(between);
  }

  static constexpr std::size_t smallest = 8;  // columns
  const PatchMesh& mesh_;
  std::vector<int> root_;                              // by node
  std::vector<std::vector<int>> columns_, neighbors_;  // by the skin's node
  std::vector<int> part_, order_;
  int parts_ = 0;
};

std::vector<int> dissected(const PatchMesh& mesh) {
  return mesh.is_body() ? ColumnDissection(mesh).order()
                        : Dissection(mesh.grid, mesh.lines_of_element()).order();
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
