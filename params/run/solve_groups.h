// The groups of cases that one process solves together.
#pragma once

#include <cstddef>
#include <vector>

#include "params/study.h"

namespace cleft {

/// Largest numbers of cases in a group, which bound the loss if a process is killed.
inline constexpr std::size_t most_solved_together = 32, most_small_together = 128;

/// Cases of at most so many nodes are solved in less time than a process takes to start (0.2 s, for the
/// libraries of deal.II and Trilinos).
inline constexpr double most_small_nodes = 5000;

/// Whether a case is that small, with the small model in a patch.
bool is_small(const Case& one);

/// Groups of cases (by index) with one stiffness matrix, which share its factorisation; groups are smaller if
/// this keeps all `workers` busy. Small cases of several stiffness matrices are in one group, where several
/// workers still have enough groups to end at about the same time.
std::vector<std::vector<std::size_t>> solve_groups(const std::vector<Case>& cases, int workers,
                                                   std::size_t most = most_small_together);

}  // namespace cleft
