#include <algorithm>
#include <cmath>
#include <span>

#include "base/error.h"
#include "solver/snapshot/snapshot_values.h"

namespace cleft {

SnapshotValues::SnapshotValues(h5::File file, std::size_t points, std::optional<TakenNodes> taken)
    : file_(std::move(file)), points_(points), taken_(std::move(taken)) {}

std::vector<double> SnapshotValues::rows(const std::string& dataset, std::size_t row, std::size_t components,
                                         std::size_t first, std::size_t count) const {
  std::vector<double> numbers;
  if (!taken_) {
    numbers.resize(components * count);
    file_.read_rows<double>(dataset, row + first, count, numbers);
    return numbers;
  }
  const std::span nodes(taken_->nodes.data() + first, count);
  if (nodes.empty()) return numbers;
  const auto [least, greatest] = std::minmax_element(nodes.begin(), nodes.end());
  const auto from = static_cast<std::size_t>(*least), to = static_cast<std::size_t>(*greatest) + 1;
  std::vector<double> all(components * (to - from));
  file_.read_rows<double>(dataset, row + from, to - from, all);
  numbers.reserve(components * count);
  for (const std::int32_t n : nodes) {
    const auto at = all.begin() + static_cast<std::ptrdiff_t>(components * (n - from));
    numbers.insert(numbers.end(), at, at + static_cast<std::ptrdiff_t>(components));
  }
  turn(numbers, static_cast<int>(components), taken_->axes);
  return numbers;
}

std::vector<Vec3> SnapshotValues::displacement(std::size_t frame, std::size_t first,
                                               std::size_t count) const {
  const std::vector<double> numbers =
      rows(point_data_group + "/displacement", frame * points_, 3, first, count);
  std::vector<Vec3> vectors(count);
  for (std::size_t n = 0; n < count; ++n) {
    vectors[n] = {numbers[3 * n], numbers[3 * n + 1], numbers[3 * n + 2]};
    if (!std::isfinite(squared_norm(vectors[n])))
      throw FileError(file_.path(), "frame " + std::to_string(frame) + ", node " + std::to_string(first + n) +
                                        " holds a displacement that is not finite");
  }
  return vectors;
}

std::vector<double> SnapshotValues::array(const SnapshotArray& array, std::size_t frame, std::size_t first,
                                          std::size_t count) const {
  return rows(point_data_group + "/" + array.name, array.varies ? frame * points_ : 0, array.components,
              first, count);
}

}  // namespace cleft
