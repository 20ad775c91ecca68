// Recorded parameters of a few names and numbers.
#pragma once

#include <map>
#include <string>

#include "params/parameters/recorded.h"

namespace cleft {

inline RecordedParameters recorded(const std::map<std::string, double>& numbers) {
  RecordedParameters parameters;
  for (const auto& [name, value] : numbers) parameters.set(name, value);
  return parameters;
}

}  // namespace cleft
