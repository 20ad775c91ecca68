// Displacements of all nodes in all frames as one array of 32-bit floats, and the errors of an approximation
// of it.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "encoder/series.h"

namespace cleft {

/// From frame 0, which is left out: values[(frame * nodes + node) * 3 + axis], mm.
struct NodeData {
  explicit NodeData(const Series& series);

  std::size_t nodes, frames;
  std::vector<float> values;
  double largest = 0, squared = 0;  ///< largest displacement, mm; sum of all squares
  double raw_bytes() const { return 12. * static_cast<double>(nodes * (frames + 1)); }
};

/// Relative to the largest displacement, and to the root of the sum of squares.
struct Errors {
  double node_error = 0, relative_l2 = 0;
};
Errors errors_of(const NodeData& data, const std::vector<float>& approximation);

enum class Goal { node_error, relative_l2 };
double of(const Errors& errors, Goal goal);

/// The smallest approximation of a method within a bound of the error.
struct Compressed {
  double bytes = 0;
  Errors errors;
  std::string how;
  double nanoseconds_a_point = 0;  ///< to decode all nodes and frames, over their number; 0: not timed
};

/// The largest step, to 1 %, whose approximation stays within `limit`: the error grows with the step.
Compressed coarsest_within(const std::function<Compressed(double step)>& compress, Goal goal, double limit,
                           double first_step);

}  // namespace cleft
