#include "encoder/node_values.h"

#include "encoder/node_work.h"

namespace cleft {

namespace {

NodeRows rows_of(const std::vector<Vec3>& vectors) {
  NodeRows rows(static_cast<Eigen::Index>(vectors.size()), 3);
  for (std::size_t n = 0; n < vectors.size(); ++n)
    rows.row(static_cast<Eigen::Index>(n)) << vectors[n].x, vectors[n].y, vectors[n].z;
  return rows;
}

}  // namespace

NodesInFile NodesInFile::part(std::size_t first, std::size_t count) const {
  NodesInFile part{file, points, TakenNodes{{}, taken ? taken->axes : same_axes}, {}, quantities};
  part.taken->nodes.reserve(count);
  for (std::size_t n = first; n < first + count; ++n)
    part.taken->nodes.push_back(taken ? taken->nodes[n] : static_cast<std::int32_t>(n));
  if (!axes.empty())
    part.axes.assign(axes.begin() + static_cast<std::ptrdiff_t>(first),
                     axes.begin() + static_cast<std::ptrdiff_t>(first + count));
  return part;
}

NodeValues::NodeValues(NodesInFile nodes)
    : nodes_(std::move(nodes)),
      values_(h5::File::open(nodes_.file), nodes_.points, nodes_.taken),
      closed_(rows_of(values_.displacement(0, 0, nodes_.size()))) {}

NodeRows NodeValues::values(int field, std::size_t frame, std::size_t first, std::size_t count) const {
  return field == NodeSpline::displacement ? displacement(frame, first, count)
                                           : quantity(static_cast<std::size_t>(field), frame, first, count);
}

NodeRows NodeValues::displacement(std::size_t frame, std::size_t first, std::size_t count) const {
  NodeRows rows;
  {
    const std::lock_guard held(one_at_a_time_);
    rows = rows_of(values_.displacement(frame, first, count));
  }
  rows -= closed_.middleRows(static_cast<Eigen::Index>(first), static_cast<Eigen::Index>(count));
  for (std::size_t n = 0; n < count && !nodes_.axes.empty(); ++n) {
    auto row = rows.row(static_cast<Eigen::Index>(n));
    const Vec3 d = turned({row(0), row(1), row(2)}, nodes_.axes[first + n]);
    row << d.x, d.y, d.z;
  }
  return rows;
}

NodeRows NodeValues::quantity(std::size_t number, std::size_t frame, std::size_t first,
                              std::size_t count) const {
  const SnapshotArray& array = nodes_.quantities[number];
  const auto rows = static_cast<Eigen::Index>(count);
  if (array.name.empty()) return closed_.middleRows(static_cast<Eigen::Index>(first), rows);
  const std::lock_guard held(one_at_a_time_);
  const std::vector<double> numbers = values_.array(array, frame, first, count);
  return Eigen::Map<const NodeRows>(numbers.data(), rows, static_cast<Eigen::Index>(array.components));
}

}  // namespace cleft
