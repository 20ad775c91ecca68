// The series of a case of the finite model.
#pragma once

#include "solver/case_output.h"

namespace cleft {

/// Solves the frames of a case one after another, each from the last, and writes its snapshot. Throws
/// SolveError. Collective.
void solve_finite_series(SharedStiffness& shared, const Release& release, std::size_t number);

}  // namespace cleft
