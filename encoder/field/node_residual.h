// What a field's spline leaves of the displacements at the nodes, quantised, and its lossless code. The bytes
// are stated in docs/formats.md.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/vec3.h"

namespace cleft {

/// Whole multiples of `quantum` (mm), mostly 0: added to the spline's displacement at each node and frame
/// after frame 0.
struct NodeResidual {
  double quantum = 0;
  int nodes = 0, frames = 0;         ///< frames without frame 0
  std::vector<std::int32_t> values;  ///< (node * 3 + component) * frames + frame

  /// Of a frame of the series, from 1 on.
  std::int32_t& value(std::size_t node, int component, std::size_t frame) {
    return values[place(node, component, frame)];
  }
  /// mm; nothing in frame 0.
  Vec3 at(std::size_t node, std::size_t frame) const {
    Vec3 off;
    for (int c = 0; frame > 0 && c < 3; ++c) off[c] = quantum * values[place(node, c, frame)];
    return off;
  }

 private:
  std::size_t place(std::size_t node, int component, std::size_t frame) const {
    return (node * 3 + static_cast<std::size_t>(component)) * static_cast<std::size_t>(frames) + frame - 1;
  }
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
