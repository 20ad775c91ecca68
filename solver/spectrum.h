// What K looks like where it is not positive definite.
#pragma once

#include <string>

#include "solver/patch_system.h"

namespace cleft {

/// Eigenvalues of K, N/mm.
struct Spectrum {
  double smallest, largest;
};

/// By Lanczos' iteration, from within: the smallest to 1 % where it is negative and more than rounding.
/// Collective; the same on every rank.
Spectrum spectrum_of(const PatchSystem& system);

/// Throws the SolveError of a K that is not positive definite: what showed it, its eigenvalues at both
/// ends, and what to look at. Collective.
[[noreturn]] void fail_indefinite(const PatchSystem& system, const std::string& shown_by);

}  // namespace cleft
