#include "base/error.h"
#include "params/parameters/table.h"
#include "params/sampling/sampling.h"

namespace cleft {

/// All combinations of the values; the last variation changes fastest.
std::vector<Case> sample_grid(const Study& study) {
  std::vector<Case> cases = {study.base};
  for (const Variation& variation : study.vary) {
    if (cases.size() * variation.values.size() > most_cases)
      throw InputError(study.name + ": the grid has more than " + std::to_string(most_cases) +
                       " cases; give fewer values");
    std::vector<Case> next;
    for (const Case& one : cases)
      for (const Value& value : variation.values) {
        next.push_back(one);
        set_parameter(next.back().parameters, variation.name, value, study.name);
      }
    cases = std::move(next);
  }
  return cases;
}

}  // namespace cleft
