#include "explorer/commands/analysis_options.h"

#include <cstdio>

namespace cleft {

std::string rounded(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

}  // namespace cleft
