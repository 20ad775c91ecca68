#include "solver/snapshot/break_front.h"

#include <algorithm>

namespace cleft {

std::vector<bool> nodes_at_front(const std::vector<std::int64_t>& offsets,
                                 const std::vector<std::int64_t>& connectivity,
                                 const std::vector<std::array<std::int32_t, 2>>& pairs,
                                 const std::vector<std::int8_t>& sides) {
  std::vector<std::array<bool, 2>> beside(sides.size(), {false, false});
  for (std::size_t c = 0; c + 1 < offsets.size(); ++c) {
    const auto begin = connectivity.begin() + offsets[c], end = connectivity.begin() + offsets[c + 1];
    const auto has = [&](int side) {
      return std::any_of(begin, end, [&](std::int64_t n) { return sides[n] == side; });
    };
    const bool left = has(-1), right = has(1);
    if (left == right) continue;  // away from the break, or an interface element across it
    for (auto n = begin; n != end; ++n) beside[*n][right ? 1 : 0] = true;
  }
  for (const auto& [left, right] : pairs)
    for (const std::size_t side : {0, 1})
      beside[left][side] = beside[right][side] = beside[left][side] || beside[right][side];
  std::vector<bool> front(sides.size());
  for (std::size_t n = 0; n < front.size(); ++n) front[n] = sides[n] == 0 && beside[n][0] && beside[n][1];
  return front;
}

}  // namespace cleft
