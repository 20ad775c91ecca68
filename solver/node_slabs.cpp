#include "solver/node_slabs.h"

#include <algorithm>
#include <numeric>

namespace cleft {

NodeSlabs::NodeSlabs(const PatchSystem& system, std::size_t nodes) : system_(system) {
  const auto& offsets = system.offsets();
  const auto ranks = offsets.size() - 1, rank = static_cast<std::size_t>(system.rank());
  const auto slab_start = [&](std::size_t r) { return nodes * r / ranks; };
  first_ = slab_start(rank);
  count_ = slab_start(rank + 1) - first_;
  send_counts_.assign(ranks, 0), receive_counts_.assign(ranks, 0);
  std::vector<std::vector<int>> received(ranks);
  for (std::size_t r = 0; r < ranks; ++r)  // both sides list a slab's unknowns in the order of its nodes
    for (std::size_t n = slab_start(r); n < slab_start(r + 1); ++n)
      for (int axis = 0; axis < 3; ++axis) {
        const int unknown = system.unknown(static_cast<int>(n), axis);
        const auto owner = static_cast<std::size_t>(
            std::upper_bound(offsets.begin(), offsets.end(), unknown) - offsets.begin() - 1);
        if (owner == rank) {
          send_order_.push_back(unknown - system.first());
          ++send_counts_[r];
        }
        if (r == rank) received[owner].push_back(3 * static_cast<int>(n - first_) + axis);
      }
  for (std::size_t r = 0; r < ranks; ++r) {
    receive_counts_[r] = static_cast<int>(received[r].size());
    receive_places_.insert(receive_places_.end(), received[r].begin(), received[r].end());
  }
  const auto starts = [](const std::vector<int>& counts) {
    std::vector<int> s(counts.size(), 0);
    std::partial_sum(counts.begin(), counts.end() - 1, s.begin() + 1);
    return s;
  };
  send_starts_ = starts(send_counts_), receive_starts_ = starts(receive_counts_);
}

std::vector<Vec3> NodeSlabs::operator()(const double* column) const {
  std::vector<double> send(send_order_.size()), received(receive_places_.size());
  for (std::size_t i = 0; i < send.size(); ++i) send[i] = column[send_order_[i]];
  MPI_Alltoallv(send.data(), send_counts_.data(), send_starts_.data(), MPI_DOUBLE, received.data(),
                receive_counts_.data(), receive_starts_.data(), MPI_DOUBLE, system_.communicator());
  std::vector<Vec3> displacement(count_);
  for (std::size_t i = 0; i < received.size(); ++i)
    displacement[receive_places_[i] / 3][receive_places_[i] % 3] = received[i];
  return displacement;
}

}  // namespace cleft
