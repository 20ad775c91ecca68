// The snapshot of a case that is not solved: its mesh, its cut and its times.
#pragma once

#include <mpi.h>

#include <string>

#include "params/parameters/parameters.h"

namespace cleft {

/// Displacements are 0, and so are gaps; the relative residual of the forces is therefore 1. It has no
/// identity of a case (Snapshot::case_hash). Collective.
void write_unsolved(const Parameters& parameters, const std::string& out, MPI_Comm communicator);

}  // namespace cleft
