// What a case is refused for.
#pragma once

#include <string>

#include "base/error.h"
#include "params/consistency.h"
#include "params/parameters/parameters.h"

namespace cleft {

/// What check_consistency says of the parameters; empty where it takes them.
inline std::string refusal_of(const Parameters& parameters) {
  try {
    check_consistency(parameters, "case");
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

}  // namespace cleft
