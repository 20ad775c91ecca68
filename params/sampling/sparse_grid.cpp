#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <set>

#include "base/error.h"
#include "base/text.h"
#include "params/parameters/table.h"
#include "params/sampling/sampling.h"

namespace cleft {

namespace {

/// The nodes of one range that a level adds, from 0 to 1: its middle, its ends, then the Chebyshev points
/// between (Clenshaw and Curtis).
std::vector<double> added_nodes(int level) {
  if (level == 0) return {0.5};
  if (level == 1) return {0, 1};
  std::vector<double> nodes;
  const int intervals = 1 << level;
  for (int i = 1; i < intervals; i += 2)
    nodes.push_back((1 - std::cos(std::numbers::pi * i / intervals)) / 2);
  return nodes;
}

/// Whether what is varied alone is, but for the others of its group.
bool are_allowed(const std::vector<int>& levels, const std::vector<Variation>& ranges) {
  std::size_t raised = 0, alone = 0;
  std::set<std::string> groups;
  for (std::size_t k = 0; k < levels.size(); ++k)
    if (levels[k] > 0) ++raised, alone += ranges[k].range->alone, groups.insert(ranges[k].range->group);
  const bool of_one_group = alone == raised && groups.size() == 1 && !groups.begin()->empty();
  return alone == 0 || raised == 1 || of_one_group;
}

/// Whether ranges that have no pairs with one another are raised together.
bool are_kept_apart(const std::vector<int>& levels, const std::vector<Variation>& ranges) {
  for (std::size_t k = 0; k < levels.size(); ++k)
    for (std::size_t other = 0; other < levels.size(); ++other)
      if (levels[k] > 0 && levels[other] > 0 &&
          std::ranges::find(ranges[k].range->not_with, ranges[other].name) != ranges[k].range->not_with.end())
        return true;
  return false;
}

double number_of(const Case& one, const Variation& variation) {
  return std::get<double>(get_parameter(one.parameters, *find_parameter(variation.name)));
}

/// The parts of the ranges at a node of each. Where two that share are both raised, each goes half as far
/// from its middle: within the diamond of their ends.
std::vector<double> parts_of(const std::vector<Variation>& ranges,
                             const std::vector<std::vector<double>>& nodes,
                             const std::vector<std::size_t>& at, const std::vector<int>& levels) {
  std::vector<double> parts;
  for (std::size_t k = 0; k < ranges.size(); ++k) parts.push_back(nodes[k][at[k]]);
  for (std::size_t k = 0; k < ranges.size(); ++k)
    for (std::size_t other = 0; other < ranges.size(); ++other)
      if (ranges[other].name == ranges[k].range->shares && levels[k] > 0 && levels[other] > 0)
        for (const std::size_t one : {k, other}) parts[one] = (parts[one] + 0.5) / 2;
  return parts;
}

/// Calls `use` with every list of `levels.size()` levels whose sum is `total`, in lexicographical order.
template <class Use>
void for_each_sum(std::vector<int>& levels, std::size_t from, int total, const Use& use) {
  if (from + 1 == levels.size()) {
    levels[from] = total;
    use();
    return;
  }
  for (levels[from] = 0; levels[from] <= total; ++levels[from])
    for_each_sum(levels, from + 1, total - levels[from], use);
}

}  // namespace

/// The sparse grid of Smolyak (1963) with nested Chebyshev points: level 1 is the middle of all ranges and
/// the ends of each, level 2 adds two points between on each and the ends of all pairs. Polynomials of as
/// high a total degree as the level are exact between them. A higher level keeps the cases of the lower ones.
/// What is varied alone has the nodes of one range, and pairs within its group; the middle is the case's own
/// value. Ranges that are not varied with others have no pairs with these.
std::vector<Case> sample_sparse_grid(const Study& study) {
  const std::vector<Variation> ranges = ranges_by_name(study);
  std::vector<Case> cases;
  std::vector<int> levels(ranges.size());
  for (int total = 0; total <= study.sampling.level; ++total)
    for_each_sum(levels, 0, total, [&] {
      if (!are_allowed(levels, ranges) || are_kept_apart(levels, ranges)) return;
      std::vector<std::vector<double>> nodes;
      nodes.reserve(levels.size());
      for (const int level : levels) nodes.push_back(added_nodes(level));
      std::vector<std::size_t> at(ranges.size(), 0);
      for (bool more = true; more;) {
        Case one(study.base);
        bool again = false;  // what is varied alone has its own value at a node
        const std::vector<double> parts = parts_of(ranges, nodes, at, levels);
        for (std::size_t k = 0; k < ranges.size(); ++k) {
          const Range& range = *ranges[k].range;
          if (levels[k] == 0 && range.alone) continue;
          set_drawn(one, ranges[k], parts[k], 1);
          for (const auto& [name, value] : range.with)
            set_parameter(one.parameters, name, value, ranges[k].name);
          again = again || (range.alone && range.with.empty() &&
                            number_of(one, ranges[k]) == number_of(study.base, ranges[k]));
        }
        if (!again) cases.push_back(std::move(one));
        more = false;
        for (std::size_t k = ranges.size(); k-- > 0 && !more;) {
          more = ++at[k] < nodes[k].size();
          if (!more) at[k] = 0;
        }
      }
      if (cases.size() > most_cases)
        throw InputError(study.name + ": sampling.level = " + std::to_string(study.sampling.level) + " for " +
                         std::to_string(ranges.size()) + " ranges makes more than " +
                         std::to_string(most_cases) + " cases; take a lower one");
    });
  return cases;
}

}  // namespace cleft
