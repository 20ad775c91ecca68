#include "encoder/interpolate/parameter_groups.h"

#include <algorithm>
#include <numeric>
#include <set>

#include "encoder/interpolate/features.h"

namespace cleft {

namespace {

std::map<std::string, double> base_of(const std::vector<RecordedParameters>& cases) {
  std::map<std::string, double> base;
  for (const std::string& name : varying_parameters(cases)) {
    if (is_prestress(cases.front(), name)) continue;
    std::map<double, int> count;
    for (const RecordedParameters& one : cases) ++count[one.number(name).value()];
    base[name] = std::max_element(count.begin(), count.end(), [](const auto& a, const auto& b) {
                   return a.second < b.second;
                 })->first;
  }
  return base;
}

/// Puts names that vary in one case into one set.
std::vector<std::set<std::string>> sets_of(const std::vector<std::set<std::string>>& varied) {
  std::vector<std::set<std::string>> sets;
  for (const auto& names : varied) {
    std::set<std::string> joined = names;
    std::erase_if(sets, [&](const std::set<std::string>& other) {
      const bool meets =
          std::any_of(other.begin(), other.end(), [&](const auto& name) { return joined.contains(name); });
      if (meets) joined.insert(other.begin(), other.end());
      return meets;
    });
    if (!joined.empty()) sets.push_back(joined);
  }
  return sets;
}

}  // namespace

ParameterGroups parameter_groups(const std::vector<RecordedParameters>& cases) {
  ParameterGroups groups;
  groups.base = base_of(cases);
  std::vector<std::set<std::string>> varied;  // of each case
  for (const RecordedParameters& one : cases) {
    auto& names = varied.emplace_back();
    for (const auto& [name, value] : groups.base)
      if (one.number(name).value() != value) names.insert(name);
  }
  std::vector<int> all(cases.size());
  std::iota(all.begin(), all.end(), 0);
  const auto where = [&](const auto& holds) {
    std::vector<int> list;
    std::copy_if(all.begin(), all.end(), std::back_inserter(list),
                 [&](int i) { return holds(varied[static_cast<std::size_t>(i)]); });
    return list;
  };
  const auto none_of = [](const std::set<std::string>& names, const std::set<std::string>& set) {
    return std::none_of(names.begin(), names.end(), [&](const auto& name) { return set.contains(name); });
  };
  const auto sets = sets_of(varied);
  const auto at_base = where([](const auto& names) { return names.empty(); });
  const auto main = std::find_if(sets.begin(), sets.end(), [&](const auto& set) {
    return set.size() > 1 &&
           2 * where([&](const auto& names) { return !none_of(names, set); }).size() > all.size();
  });
  groups.together.cases = all;
  for (const auto& [name, value] : groups.base) groups.together.names.push_back(name);
  if (main == sets.end() || sets.size() == 1 || at_base.empty()) return groups;
  const auto group_of = [&](const std::set<std::string>& set) {
    return ParameterGroup{{set.begin(), set.end()},
                          where([&](const auto& names) { return names.empty() || !none_of(names, set); })};
  };
  groups.together = group_of(*main);
  for (const auto& set : sets)
    if (set != *main) groups.alone.push_back(group_of(set));
  return groups;
}

}  // namespace cleft
