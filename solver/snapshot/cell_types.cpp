#include "solver/snapshot/cell_types.h"

#include <map>
#include <set>

namespace cleft {

using Edges = std::vector<std::array<std::size_t, 2>>;

const Edges& edges_of_type(int type) {
  static const std::map<int, Edges> of_types = {
      {5, {{0, 1}, {1, 2}, {2, 0}}},
      {8, {{0, 1}, {1, 3}, {3, 2}, {2, 0}}},
      {9, {{0, 1}, {1, 2}, {2, 3}, {3, 0}}},
      {10, {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}},
      {11, {{0, 1}, {1, 3}, {3, 2}, {2, 0}, {4, 5}, {5, 7}, {7, 6}, {6, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}}},
      {12, {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}}},
      {13, {{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}}},
      {14, {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {1, 4}, {2, 4}, {3, 4}}}};
  static const Edges none;
  const auto found = of_types.find(type);
  return found == of_types.end() ? none : found->second;
}

bool is_flat_type(int type) {
  static const std::set<int> flat = {1,  2,  3,  4,  5,  6,  7,  8,  9,  21, 22,
                                     23, 28, 34, 35, 36, 68, 69, 70, 75, 76, 77};
  return flat.contains(type);
}

}  // namespace cleft
