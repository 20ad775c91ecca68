#include "encoder/series_samples.h"

#include <algorithm>
#include <mutex>
#include <span>

#include "encoder/fitted_nodes.h"

namespace cleft {

SeriesSamples::SeriesSamples(const Snapshot& s, const std::vector<Sample>& places,
                             std::shared_ptr<const OwnCoordinates> own, std::size_t nodes, std::size_t most)
    : own_(std::move(own)), nodes_(nodes), places_(places.size()), fitted_(fitted_nodes(s, places, most)) {}

std::size_t SeriesSamples::nodes() const {
  if (!in_part()) return nodes_;
  const auto end = std::lower_bound(fitted_.begin(), fitted_.end(), static_cast<std::int32_t>(nodes_));
  return static_cast<std::size_t>(end - fitted_.begin());
}

Eigen::MatrixXd SeriesSamples::at_samples(const Eigen::MatrixXd& values) const {
  if (!own_ && !in_part()) return values;
  Eigen::MatrixXd taken(static_cast<Eigen::Index>(size()), values.cols());
  for (std::size_t i = 0; i < size(); ++i)
    taken.row(static_cast<Eigen::Index>(i)) = values.row(static_cast<Eigen::Index>(node_of(place(i))));
  return taken;
}

SeriesSamples::Pairs SeriesSamples::pairs_of(const Pairs& pairs) const {
  if (!in_part()) return pairs;
  const auto sample_of = [this](std::int32_t place) {
    return static_cast<std::int32_t>(std::lower_bound(fitted_.begin(), fitted_.end(), place) -
                                     fitted_.begin());
  };
  Pairs taken;
  for (const auto& [left, right] : pairs) taken.push_back({sample_of(left), sample_of(right)});
  return taken;
}

Snapshot SeriesSamples::cells_of(const Snapshot& s) const {
  std::vector<std::int64_t> number(places_, -1);
  for (std::size_t i = 0; i < size(); ++i) number[place(i)] = static_cast<std::int64_t>(i);
  Snapshot part;
  part.cell_offsets = {0};
  for (std::size_t c = 0; c + 1 < s.cell_offsets.size(); ++c) {
    const std::span cell(s.connectivity.begin() + s.cell_offsets[c],
                         s.connectivity.begin() + s.cell_offsets[c + 1]);
    if (std::any_of(cell.begin(), cell.end(), [&](std::int64_t n) { return number[n] < 0; })) continue;
    for (const std::int64_t n : cell) part.connectivity.push_back(number[n]);
    part.cell_offsets.push_back(static_cast<std::int64_t>(part.connectivity.size()));
  }
  return part;
}

ReadNodes SeriesSamples::reading(ReadRows read) const {
  if (!in_part()) return {};
  const auto one_at_a_time = [read = std::move(read), lock = std::make_shared<std::mutex>()](
                                 std::size_t frame, std::size_t first, std::size_t count) {
    const std::lock_guard held(*lock);  // HDF5 serves one thread at a time
    return read(frame, first, count);
  };
  if (!own_) return one_at_a_time;
  // The places of nodes are in the order of the nodes, some of which have none.
  return [one_at_a_time, own = own_](std::size_t frame, std::size_t first, std::size_t count) {
    const std::size_t from = own->kept[first], to = own->kept[first + count - 1] + 1;
    const NodeRows all = one_at_a_time(frame, from, to - from);
    Eigen::MatrixXd values(static_cast<Eigen::Index>(count), all.cols());
    for (std::size_t i = 0; i < count; ++i)
      values.row(static_cast<Eigen::Index>(i)) =
          all.row(static_cast<Eigen::Index>(own->kept[first + i] - from));
    return values;
  };
}

ReadNodes SeriesSamples::reading_displacements(ReadRows read) const {
  ReadNodes along_axes = reading(std::move(read));
  if (!own_ || !along_axes) return along_axes;
  return [along_axes, own = own_](std::size_t frame, std::size_t first, std::size_t count) {
    Eigen::MatrixXd values = along_axes(frame, first, count);
    for (Eigen::Index i = 0; i < values.rows(); ++i) {
      const Vec3 d = own->components(own->kept[first + static_cast<std::size_t>(i)],
                                     {values(i, 0), values(i, 1), values(i, 2)});
      values.row(i) << d.x, d.y, d.z;
    }
    return values;
  };
}

}  // namespace cleft
