// Companions of a case: the same cut in other meshes, from which the error of its own mesh and patch is
// estimated.
#pragma once

#include <mpi.h>

#include <optional>
#include <string>

#include "params/parameters/parameters.h"

namespace cleft {

class KeptPatches;

/// The largest opening of the whole cut, mm, from its last frame alone. Throws InputError
/// if the parameters do not fit together, SolveError if they have no solution. `kept`: patches of earlier
/// ones, for which this one is kept too. Collective.
double gape_of(const Parameters& parameters, MPI_Comm communicator, KeptPatches* kept = nullptr);

/// Expected errors of the largest opening of the whole cut, relative to it.
struct ExpectedError {
  /// What elements twice as long change, or twice what elements half as long change, and a third of what
  /// elements change that grow by the square of the mesh's grading.
  double mesh = 0;
  double patch = 0;  ///< what a patch twice as long and wide changes, in the coarser of these elements
  double total() const { return mesh + patch; }
};

/// Expected errors, or why there are none: exactly one of both.
struct ErrorEstimate {
  std::optional<ExpectedError> expected;
  std::string obstacle;  ///< what stands in the way, and what can be done
};

/// For a case whose own largest opening is `gape`, mm; takes about a third of the time of its solution. Where
/// elements twice as long do not fit the cut, its companions have elements half as long, in a patch that is
/// no larger than the cut needs. All companions are of the small model: mesh and patch err by the same part
/// of the opening in both. Collective.
ErrorEstimate expected_error(const Parameters& parameters, double gape, MPI_Comm communicator,
                             KeptPatches* kept = nullptr);

}  // namespace cleft
