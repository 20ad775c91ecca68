// Proper orthogonal decomposition over the frames: modes in space times histories.
#pragma once

#include "tradeoff/rivals/node_data.h"

namespace cleft {

class Pod {
 public:
  explicit Pod(const NodeData& data);
  /// The fewest modes within the limit; 4 (3 N + F) bytes each.
  Compressed within(Goal goal, double limit) const;

 private:
  std::vector<Errors> errors_;  // with one mode, two, ...
  double bytes_a_mode_ = 0;
};

}  // namespace cleft
