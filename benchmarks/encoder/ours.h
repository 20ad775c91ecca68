// Our encoder, timed, and the errors of what its file gives back.
#pragma once

#include <string>

#include "encoder/field/field.h"
#include "solver/snapshot/snapshot.h"
#include "tradeoff/rivals/node_data.h"

namespace cleft {

struct OurRun {
  double coefficient_bytes = 0, residual_bytes = 0, file_bytes = 0;
  Errors errors;              ///< of the file, read again
  double centroid_error = 0;  ///< at cells' centroids, against the mean of the cell's nodes
  double later_error = 0;     ///< the same but for the first frame left out
  std::size_t unseen_frame = 0;
  double unseen_error = 0;  ///< at nodes in frames the fit did not see, of the spline, and the frame
  double fit = 0, write = 0, verify = 0;  ///< seconds
  double peak_bytes = 0;                  ///< of the process so far
};

/// Encodes, writes, reads again and measures.
OurRun run_ours(const Series& series, const Snapshot& snapshot, const NodeData& data, double tolerance);

}  // namespace cleft
