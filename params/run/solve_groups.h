// The groups of cases that one process solves together.
#pragma once

#include <cstddef>
#include <vector>

#include "params/study.h"

namespace cleft {

/// Largest number of cases in a group, which bounds the loss if a process is killed.
inline constexpr std::size_t most_solved_together = 32;

/// Groups of cases (by index) with one stiffness matrix, which share its factorisation; groups are smaller if
/// this keeps all `workers` busy.
std::vector<std::vector<std::size_t>> solve_groups(const std::vector<Case>& cases, int workers,
                                                   std::size_t most = most_solved_together);

}  // namespace cleft
