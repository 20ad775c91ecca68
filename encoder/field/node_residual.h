// The quantised residual of a field's spline at the nodes, and its lossless code. docs/formats.md specifies
// the bytes.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/vec3.h"

namespace cleft {

/// Whole multiples of `quantum` (mm, or the quantity's unit), mostly 0: added to the spline's value at each
/// node and frame from first_frame on.
struct NodeResidual {
  double quantum = 0;
  int nodes = 0, frames = 0;
  std::vector<std::int32_t> values;  ///< (node * components + component) * frames + frame
  int components = 3;
  int first_frame = 1;  ///< of the series: a displacement is 0 in frame 0, a further quantity need not be

  /// A value in a frame of the series, from first_frame on.
  std::int32_t& value(std::size_t node, int component, std::size_t frame) {
    return values[place(node, component, frame)];
  }
  /// The residual of one component, and of a displacement, in its unit; 0 before first_frame.
  double at(std::size_t node, int component, std::size_t frame) const {
    return frame < static_cast<std::size_t>(first_frame) ? 0
                                                         : quantum * values[place(node, component, frame)];
  }
  Vec3 at(std::size_t node, std::size_t frame) const {
    return {at(node, 0, frame), at(node, 1, frame), at(node, 2, frame)};
  }

 private:
  std::size_t place(std::size_t node, int component, std::size_t frame) const {
    return (node * static_cast<std::size_t>(components) + static_cast<std::size_t>(component)) *
               static_cast<std::size_t>(frames) +
           frame - static_cast<std::size_t>(first_frame);
  }
};

/// `order` names every node once, neighbours near each other: it only affects the number of bytes. Empty: 0,
/// 1, 2, ... Throws InputError if a value is beyond +-(2^31 - 1).
std::vector<std::uint8_t> encode_residual(const NodeResidual& residual,
                                          std::span<const std::int32_t> order = {});

/// Values of the same nodes, frames and components, in the same order; throws InputError if the bytes are
/// detectably damaged.
std::vector<std::int32_t> decode_residual(int nodes, int frames, std::span<const std::uint8_t> bytes,
                                          std::span<const std::int32_t> order = {}, int components = 3);

}  // namespace cleft
