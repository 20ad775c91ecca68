// What a field's spline leaves of the displacements at the nodes, quantised, and its lossless code. The bytes
// are stated in docs/formats.md.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace cleft {

/// Whole multiples of `quantum` (mm), mostly 0: added to the spline's displacement at each node and frame
/// after frame 0.
struct NodeResidual {
  double quantum = 0;
  int nodes = 0, frames = 0;         ///< frames without frame 0
  std::vector<std::int32_t> values;  ///< (node * 3 + component) * frames + frame
};

/// `order` names every node once, neighbours near each other: it only saves bytes. Empty: 0, 1, 2, ... Throws
/// InputError where a value is beyond +-(2^31 - 1).
std::vector<std::uint8_t> encode_residual(const NodeResidual& residual,
                                          std::span<const std::int32_t> order = {});

/// Values of the same nodes and frames, in the same order; throws InputError where the bytes are damaged and
/// it can be told.
std::vector<std::int32_t> decode_residual(int nodes, int frames, std::span<const std::uint8_t> bytes,
                                          std::span<const std::int32_t> order = {});

}  // namespace cleft
