// Which cases are solved in one go.
#pragma once

#include <cstddef>
#include <vector>

#include "params/study.h"

namespace cleft {

/// So many cases at most, so that no more than these are lost with a process.
inline constexpr std::size_t most_solved_together = 32;

/// Cases (by index) of one stiffness, whose factorisation is made once for all of them; at most so many
/// together, and fewer where that keeps `workers` busy.
std::vector<std::vector<std::size_t>> solve_groups(const std::vector<Case>& cases, int workers,
                                                   std::size_t most = most_solved_together);

}  // namespace cleft
