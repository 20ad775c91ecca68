// The quantised residual of a field's spline at the nodes, and its lossless code. docs/formats.md specifies
// the bytes.
#pragma once

#include <cstdint>
#include <span>
#include <variant>
#include <vector>

#include "base/vec3.h"

namespace cleft {

/// Whole numbers, in one byte each as long as all are small, else in four.
class SmallIntegers {
 public:
  SmallIntegers() = default;
  explicit SmallIntegers(std::size_t count) : numbers_(std::vector<std::int8_t>(count, 0)) {}
  SmallIntegers(const std::vector<std::int32_t>& numbers) : SmallIntegers(numbers.size()) {
    for (std::size_t i = 0; i < numbers.size(); ++i) set(i, numbers[i]);
  }

  std::size_t size() const {
    return std::visit([](const auto& list) { return list.size(); }, numbers_);
  }
  std::int32_t operator[](std::size_t i) const {
    return std::visit([=](const auto& list) { return static_cast<std::int32_t>(list[i]); }, numbers_);
  }
  void set(std::size_t i, std::int32_t number);
  /// All, one after another.
  static SmallIntegers joined(std::vector<SmallIntegers> parts);
  friend bool operator==(const SmallIntegers& a, const SmallIntegers& b);

 private:
  std::variant<std::vector<std::int8_t>, std::vector<std::int32_t>> numbers_;
};

/// Whole multiples of `quantum` (mm, or the quantity's unit), mostly 0: added to the spline's value at each
/// node and frame from first_frame on.
struct NodeResidual {
  double quantum = 0;
  int nodes = 0, frames = 0;
  SmallIntegers values = {};  ///< (node * components + component) * frames + frame
  int components = 3;
  int first_frame = 1;  ///< of the series: a displacement is 0 in frame 0, a further quantity need not be

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

/// A residual's code, in blocks of nodes that are coded each by itself.
struct CodedResidual {
  static constexpr int most_nodes = 1 << 18;  ///< in a block that is written

  double quantum = 0;
  int nodes = 0, frames = 0;
  int components = 3, first_frame = 1;
  int block = most_nodes;                         ///< nodes of each block but the last, which has the rest
  std::vector<std::vector<std::uint8_t>> blocks;  ///< at least one

  int first_of(int number) const { return number * block; }
  int nodes_of(int number) const { return std::min(block, nodes - first_of(number)); }
  std::size_t bytes() const;
};

/// Values of some nodes, (node * components + component) * frames + frame. Throws InputError if one is beyond
/// +-(2^31 - 1).
std::vector<std::uint8_t> encode_block(std::span<const std::int32_t> values, int components, int frames);
/// The values of a block. Throws InputError if the bytes are detectably damaged.
SmallIntegers decode_block(std::span<const std::uint8_t> bytes, int nodes, int components, int frames);

/// In blocks of so many nodes.
CodedResidual coded(const NodeResidual& residual, int block = CodedResidual::most_nodes);
/// On all cores. Throws as decode_block() does.
NodeResidual decoded(const CodedResidual& residual);

}  // namespace cleft
