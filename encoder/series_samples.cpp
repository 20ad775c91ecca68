#include "encoder/series_samples.h"

#include <algorithm>
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

NodesInFile SeriesSamples::nodes_in_file(const SnapshotValues& values,
                                         std::vector<SnapshotArray> quantities) const {
  quantities.emplace_back(SnapshotArray{"", 3, false});
  NodesInFile all{values.file().path(), values.points(), values.taken(), {}, std::move(quantities)};
  if (!own_ && !all.taken) return all;
  // The places of nodes are in the order of the nodes, some of which have none.
  NodesInFile some{all.file,
                   all.points,
                   TakenNodes{{}, all.taken ? all.taken->axes : same_axes},
                   {},
                   std::move(all.quantities)};
  for (std::size_t i = 0; i < nodes_; ++i) {
    const std::size_t n = own_ ? own_->kept[i] : i;
    some.taken->nodes.push_back(all.taken ? all.taken->nodes[n] : static_cast<std::int32_t>(n));
    if (own_) some.axes.push_back(own_->frames[n]);
  }
  return some;
}

}  // namespace cleft
