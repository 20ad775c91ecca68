// Times and memory of the steps of a solution.
#pragma once

#include <mpi.h>

#include <string>
#include <vector>

#include "base/memory.h"
#include "base/stopwatch.h"

namespace cleft {

/// A step: seconds, and the largest number of bytes that all ranks together have held so far.
struct Phase {
  std::string name;
  double seconds, peak_memory;
};

/// Records times and memory of consecutive steps.
class Phases {
 public:
  explicit Phases(MPI_Comm communicator) : communicator_(communicator) {}

  /// Ends the step that began with the last call. Collective.
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
