// Loops over nodes with three unknowns each, for several vectors at a time: the lanes.
#pragma once

#include <cstdint>

namespace cleft {

/// The vectors of a block are interleaved: unknown u of lane c is entry u * lanes + c, and node n has the
/// unknowns 3 n, 3 n + 1 and 3 n + 2. A matrix is then read once for all lanes. A lane's result does not
/// depend on how many lanes there are: the same operations are done in the same order.
constexpr int most_lanes = 8;

/// Blocks of 3 x 3 by rows of nodes.
struct BlockRows {
  int rows;
  const std::int64_t* start;
  const int* column;   ///< node
  const float* value;  ///< nine a block, by rows
};

/// A weight for each pair of a fine and a coarse node.
struct WeightRows {
  int rows;
  const std::int64_t* start;
  const int* column;
  const float* weight;
};

/// The loops for one number of lanes.
struct LaneTable {
  int lanes;
  /// r = b - A x
  void (*residual)(const BlockRows& a, const float* b, const float* x, float* r);
  /// d = keep d + step D^-1 r, x += d; D^-1: nine values a node. Without `keep` d and x are set, from 0.
  void (*relax)(int nodes, const float* inverse, float keep, float step, const float* r, float* d, float* x);
  /// coarse += P^T fine
  void (*restrict_to)(const WeightRows& p, const float* fine, float* coarse);
  /// fine += P coarse
  void (*prolong)(const WeightRows& p, const float* coarse, float* fine);
  /// The three rows of a node: y = K x, from `entries` of each row, whose columns are unknowns.
  void (*multiply_node)(int entries, const int* column, const double* const* rows, const double* x,
                        double* y);
  /// sums[c] = the inner product of lane c, over n unknowns
  void (*dot)(std::int64_t n, const double* a, const double* b, double* sums);
  void (*dot_mixed)(std::int64_t n, const float* a, const double* b, double* sums);
  /// y += factor[c] x
  void (*add)(std::int64_t n, const double* factor, const double* x, double* y);
  /// p = z + factor[c] p
  void (*follow)(std::int64_t n, const double* factor, const float* z, double* p);
};

/// For 1 lane or most_lanes, by the widest instructions that this machine has.
const LaneTable& lane_table(int lanes);

}  // namespace cleft
