// Which parameters of a study are varied together, and which alone.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "params/parameters/recorded.h"

namespace cleft {

/// Parameters that vary in some cases, and these cases, with those in which nothing varies.
struct ParameterGroup {
  std::vector<std::string> names;
  std::vector<int> cases;
};

/// Most parameters may be varied together, as on a sparse grid, and some of them alone, or a few of them with
/// one another: while all others have their base values. What these change is added to what the others
/// change.
struct ParameterGroups {
  std::map<std::string, double> base;  ///< of each parameter but prestresses: its most frequent value
  ParameterGroup together;
  std::vector<ParameterGroup> alone;  ///< none: all parameters are `together`, in all cases
};
ParameterGroups parameter_groups(const std::vector<RecordedParameters>& cases);

}  // namespace cleft
