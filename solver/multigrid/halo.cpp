#include "solver/multigrid/halo.h"

#include <algorithm>
#include <map>
#include <type_traits>
#include <unordered_map>

#include "base/error.h"

namespace cleft {

Halo::Halo(MPI_Comm communicator, const std::vector<int>& numbers, int owned, const std::vector<int>& copies,
           const std::function<int(int)>& owner)
    : communicator_(communicator) {
  int ranks = 1;
  MPI_Comm_size(communicator, &ranks);
  if (ranks == 1) return;
  std::map<int, std::vector<int>> of_rank;
  for (const int copy : copies) of_rank[owner(numbers[copy])].push_back(copy);
  std::vector<int> wanted(ranks, 0), given(ranks, 0);
  for (const auto& [rank, list] : of_rank) wanted[rank] = static_cast<int>(list.size());
  MPI_Alltoall(wanted.data(), 1, MPI_INT, given.data(), 1, MPI_INT, communicator);
  std::vector<std::vector<int>> asked(ranks), requests(ranks);
  std::vector<MPI_Request> pending;
  constexpr int tag = 71;
  for (int r = 0; r < ranks; ++r) {
    if (given[r] == 0) continue;
    requests[r].resize(given[r]);
    MPI_Irecv(requests[r].data(), given[r], MPI_INT, r, tag, communicator, &pending.emplace_back());
  }
  for (const auto& [rank, list] : of_rank) {
    for (const int copy : list) asked[rank].push_back(numbers[copy]);
    MPI_Isend(asked[rank].data(), static_cast<int>(list.size()), MPI_INT, rank, tag, communicator,
              &pending.emplace_back());
    copies_.push_back({rank, list});
  }
  MPI_Waitall(static_cast<int>(pending.size()), pending.data(), MPI_STATUSES_IGNORE);
  std::unordered_map<int, int> local;
  for (int n = 0; n < owned; ++n) local[numbers[n]] = n;
  for (int r = 0; r < ranks; ++r) {
    if (requests[r].empty()) continue;
    for (int& node : requests[r]) {
      CLEFT_CHECK(local.count(node), ==, 1U);
      node = local[node];
    }
    owned_.push_back({r, std::move(requests[r])});
  }
}

template <class T>
void Halo::exchange(const T* from, const std::vector<Peer>& send, const std::vector<Peer>& receive, int width,
                    std::vector<std::vector<T>>& received) const {
  constexpr int tag = 72;
  const MPI_Datatype type = std::is_same_v<T, float> ? MPI_FLOAT : MPI_DOUBLE;
  std::vector<MPI_Request> pending;
  std::vector<std::vector<T>> sent;
  received.clear();
  for (const Peer& peer : receive) {
    received.emplace_back(peer.nodes.size() * width);
    MPI_Irecv(received.back().data(), static_cast<int>(received.back().size()), type, peer.rank, tag,
              communicator_, &pending.emplace_back());
  }
  for (const Peer& peer : send) {
    std::vector<T>& values = sent.emplace_back();
    values.reserve(peer.nodes.size() * width);
    for (const int node : peer.nodes) {
      const T* first = from + static_cast<std::ptrdiff_t>(node) * width;
      values.insert(values.end(), first, first + width);
    }
    MPI_Isend(values.data(), static_cast<int>(values.size()), type, peer.rank, tag, communicator_,
              &pending.emplace_back());
  }
  MPI_Waitall(static_cast<int>(pending.size()), pending.data(), MPI_STATUSES_IGNORE);
}

template <class T>
void Halo::update(T* values, int width) const {
  if (copies_.empty() && owned_.empty()) return;
  std::vector<std::vector<T>> received;
  exchange(values, owned_, copies_, width, received);
  for (std::size_t p = 0; p < copies_.size(); ++p)
    for (std::size_t i = 0; i < copies_[p].nodes.size(); ++i)
      std::copy_n(received[p].data() + i * width, width,
                  values + static_cast<std::ptrdiff_t>(copies_[p].nodes[i]) * width);
}

void Halo::add_to_owners(float* values, int width) const {
  if (copies_.empty() && owned_.empty()) return;
  std::vector<std::vector<float>> received;
  exchange(values, copies_, owned_, width, received);
  for (std::size_t p = 0; p < owned_.size(); ++p)
    for (std::size_t i = 0; i < owned_[p].nodes.size(); ++i) {
      float* own = values + static_cast<std::ptrdiff_t>(owned_[p].nodes[i]) * width;
      for (int w = 0; w < width; ++w) own[w] += received[p][i * width + w];
    }
}

template void Halo::update(float*, int) const;
template void Halo::update(double*, int) const;

}  // namespace cleft
