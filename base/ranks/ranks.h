// Processes that an MPI launcher has started together: the first one works, and the others serve it.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace cleft {

using Bytes = std::vector<std::byte>;

class Ranks {
 public:
  /// Begins MPI where mpirun or srun has started several processes; else this process is the only one.
  Ranks(int& argc, char**& argv);
  ~Ranks();
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  int rank() const { return rank_; }
  int count() const { return count_; }
  /// Throws InputError if several were started together that do not know each other.
  void check() const;

  void send(int to, std::span<const std::byte> message) const;
  /// Waits for a message, without keeping a processor busy.
  Bytes receive(int from) const;

 private:
  bool begun_ = false;
  int rank_ = 0, count_ = 1;
  int started_ = 1;  // together with this one, and with it
};

}  // namespace cleft
