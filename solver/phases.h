// How long the steps of a solve take, and how much memory.
#pragma once

#include <mpi.h>

#include <string>
#include <vector>

#include "base/memory.h"
#include "base/stopwatch.h"

namespace cleft {

/// A step of the work: seconds, and the most bytes the ranks together have held so far.
struct Phase {
  std::string name;
  double seconds, peak_memory;
};

/// Times and memory of one phase after the other.
class Phases {
 public:
  explicit Phases(MPI_Comm communicator) : communicator_(communicator) {}

  /// What was done since the last call. Collective.
  void end(const std::string& name) {
    const double seconds = watch_.lap();
    double peak = peak_memory();
    MPI_Allreduce(MPI_IN_PLACE, &peak, 1, MPI_DOUBLE, MPI_SUM, communicator_);
    for (Phase& phase : list)
      if (phase.name == name) {
        phase.seconds += seconds, phase.peak_memory = peak;
        return;
      }
    list.push_back({name, seconds, peak});
  }

  std::vector<Phase> list;

 private:
  MPI_Comm communicator_;
  Stopwatch watch_;
};

}  // namespace cleft
