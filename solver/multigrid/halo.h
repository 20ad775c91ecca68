// Values at nodes that other ranks own.
#pragma once

#include <mpi.h>

#include <functional>
#include <vector>

namespace cleft {

/// Copies of the nodes of other ranks. A rank's nodes are numbered: its own first, then copies.
class Halo {
 public:
  Halo() = default;
  /// `numbers`: by local node, its number in the whole mesh; the first `owned` are this rank's. `copies`:
  /// local numbers of those to keep up to date. `owner`: the rank of a node of the mesh. Collective.
  Halo(MPI_Comm communicator, const std::vector<int>& numbers, int owned, const std::vector<int>& copies,
       const std::function<int(int)>& owner);

  /// Sets the copies to their owners' values; `width` values a node. Collective.
  template <class T>
  void update(T* values, int width) const;
  /// Adds the copies' values to those of their owners. Collective.
  void add_to_owners(float* values, int width) const;

 private:
  struct Peer {
    int rank;
    std::vector<int> nodes;  // local
  };
  template <class T>
  void exchange(const T* from, const std::vector<Peer>& send, const std::vector<Peer>& receive, int width,
                std::vector<std::vector<T>>& received) const;

  MPI_Comm communicator_ = MPI_COMM_NULL;
  std::vector<Peer> copies_, owned_;  // what this rank has of others, and others of it
};

}  // namespace cleft
