#include "base/error.h"
#include "params/parameters/table.h"
#include "params/sampling/sampling.h"

namespace cleft {

/// The n-th case takes the n-th value of every variation; the lists must be equally long.
std::vector<Case> sample_list(const Study& study) {
  std::vector<Case> cases(study.vary.empty() ? 1 : study.vary.front().values.size(), study.base);
  for (const Variation& variation : study.vary) {
    if (variation.values.size() != cases.size())
      throw InputError(study.name + ": sampling method 'list' needs lists of equal length; '" +
                       study.vary.front().name + "' has " + std::to_string(cases.size()) + " values and '" +
                       variation.name + "' " + std::to_string(variation.values.size()));
    for (std::size_t i = 0; i < cases.size(); ++i)
      set_parameter(cases[i].parameters, variation.name, variation.values[i], study.name);
  }
  return cases;
}

}  // namespace cleft
