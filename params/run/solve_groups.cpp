#include "params/run/solve_groups.h"

#include <algorithm>
#include <string>
#include <unordered_map>

#include "params/consistency.h"
#include "params/stiffness.h"

namespace cleft {

namespace {

using Groups = std::vector<std::vector<std::size_t>>;

/// Joins groups of small cases, to at most so many cases.
Groups joined(Groups groups, const std::vector<Case>& cases, std::size_t workers, std::size_t most) {
  const std::size_t groups_a_worker = workers > 1 ? 4 : 1;  // one worker keeps no other one waiting
  const auto end_of_small = std::stable_partition(
      groups.begin(), groups.end(), [&](const auto& group) { return is_small(cases[group.front()]); });
  std::size_t small = 0;
  for (auto group = groups.begin(); group != end_of_small; ++group) small += group->size();
  most = std::min({most, most_small_together, small / (groups_a_worker * workers)});
  Groups result;
  for (auto group = groups.begin(); group != groups.end(); ++group)
    if (group > groups.begin() && group < end_of_small && result.back().size() + group->size() <= most)
      result.back().insert(result.back().end(), group->begin(), group->end());
    else
      result.push_back(std::move(*group));
  return result;
}

}  // namespace

bool is_small(const Case& one) {
  return one.body.empty() && one.parameters.model == Model::small &&
         estimated_nodes(one.parameters) <= most_small_nodes;
}

std::vector<std::vector<std::size_t>> solve_groups(const std::vector<Case>& cases, int workers,
                                                   std::size_t most) {
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
    const std::size_t bound =
        std::min(most, is_small(cases[members.front()]) ? most_small_together : most_solved_together);
    const std::size_t needed = (members.size() + bound - 1) / bound;
    const std::size_t count = std::min(members.size(), std::max(parts, needed));
    for (std::size_t part = 0; part < count; ++part)
      groups.emplace_back(members.begin() + static_cast<std::ptrdiff_t>(part * members.size() / count),
                          members.begin() + static_cast<std::ptrdiff_t>((part + 1) * members.size() / count));
  }
  return joined(std::move(groups), cases, idle, most);
}

}  // namespace cleft
