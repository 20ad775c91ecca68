// From a case to its snapshot.
#pragma once

#include <mpi.h>

#include <functional>
#include <string>

#include "params/parameters.h"

namespace cleft {

struct SolveReport {
  int ranks = 1, nodes = 0, unknowns = 0, pairs = 0, frames = 0;
  double seconds_assemble = 0, seconds_factor = 0, seconds_frames = 0;
  double gape = 0;                  ///< mm: largest opening along v in the last frame
  double largest_displacement = 0;  ///< mm, from frame 0
  double worst_equilibrium = 0, worst_closure = 0, smallest_gap = 0;
};

/// Solves a case and writes its snapshot to `out`, which appears whole or not at all. Collective; the report
/// is complete on rank 0. `progress` is told what is being done.
SolveReport solve_case(const Parameters& parameters, const std::string& out, MPI_Comm communicator,
                       const std::function<void(const std::string&)>& progress);

}  // namespace cleft
