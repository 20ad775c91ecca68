// Extreme eigenvalues of K, for messages if it is not positive definite.
#pragma once

#include <string>

#include "solver/patch_system.h"

namespace cleft {

/// Eigenvalues of K, N/mm.
struct Spectrum {
  double smallest, largest;
};

/// Lanczos iteration, whose values are inside the spectrum: the smallest is within 1 % if it is negative
/// beyond rounding. Collective; equal on all ranks.
Spectrum spectrum_of(const PatchSystem& system);

/// Throws the SolveError for a K that is not positive definite: how it was detected, the extreme eigenvalues,
/// and the remedy. Collective.
[[noreturn]] void fail_indefinite(const PatchSystem& system, const std::string& shown_by);

}  // namespace cleft
