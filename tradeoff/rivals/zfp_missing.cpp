// Instead of zfp_rival.cpp where there is no libzfp.
#include <stdexcept>

#include "tradeoff/rivals/zfp_rival.h"

namespace cleft {

bool zfp_is_there() { return false; }

Compressed zfp_within(const NodeData&, std::span<const int>, Goal, double) {
  throw std::logic_error("no zfp");
}

std::optional<Compressed> decimated_within(const NodeData&, const std::vector<Sample>&, Goal, double) {
  return std::nullopt;
}

}  // namespace cleft
