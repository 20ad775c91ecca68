#include "params/run/solve_groups.h"

#include <algorithm>
#include <string>
#include <unordered_map>

#include "params/stiffness.h"

namespace cleft {

std::vector<std::vector<std::size_t>> solve_groups(const std::vector<Case>& cases, int workers,
                                                   std::size_t most) {
  most = std::min(most, most_solved_together);
  std::vector<std::vector<std::size_t>> of_one_stiffness;
  std::unordered_map<std::string, std::size_t> group;
  for (std::size_t c = 0; c < cases.size(); ++c) {
    const auto [found, is_new] = group.emplace(stiffness_key(cases[c].parameters), of_one_stiffness.size());
    if (is_new) of_one_stiffness.emplace_back();
    of_one_stiffness[found->second].push_back(c);
  }
  const std::size_t idle = static_cast<std::size_t>(std::max(1, workers));
  const std::size_t parts =
      (idle + of_one_stiffness.size() - 1) / std::max<std::size_t>(1, of_one_stiffness.size());
  std::vector<std::vector<std::size_t>> groups;
  for (const auto& members : of_one_stiffness) {
    const std::size_t needed = (members.size() + most - 1) / most;
    const std::size_t count = std::min(members.size(), std::max(parts, needed));
    for (std::size_t part = 0; part < count; ++part)
      groups.emplace_back(members.begin() + static_cast<std::ptrdiff_t>(part * members.size() / count),
                          members.begin() + static_cast<std::ptrdiff_t>((part + 1) * members.size() / count));
  }
  return groups;
}

}  // namespace cleft
