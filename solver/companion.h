// Companions of a case: the same cut in coarser meshes, from which the error of its own mesh and patch is
// estimated.
#pragma once

#include <mpi.h>

#include <optional>

#include "params/parameters/parameters.h"

namespace cleft {

/// The largest opening of the whole cut, mm, from its last frame alone. Throws InputError if the parameters
/// do not fit together, SolveError if they have no solution. Collective.
double gape_of(const Parameters& parameters, MPI_Comm communicator);

/// Expected errors of the largest opening of the whole cut, relative to it.
struct ExpectedError {
  double mesh = 0;   ///< what elements twice as long change
  double patch = 0;  ///< what a patch twice as long and wide changes, in elements twice as long
  double total() const { return mesh + patch; }
};

/// For a case whose own largest opening is `gape`, mm; takes about a third of the time of its solution. None
/// where the companions cannot be made: elements twice as long leave the cut no node to open. Collective.
std::optional<ExpectedError> expected_error(const Parameters& parameters, double gape, MPI_Comm communicator);

}  // namespace cleft
