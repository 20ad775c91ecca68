#include "params/sampling/sampling.h"

namespace cleft {

std::vector<Case> sample_grid(const Study& study) {
  std::vector<Case> cases = {study.base};
  for (const Variation& variation : study.vary) {
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
