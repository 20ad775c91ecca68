// Differences of the values of coincident nodes, frame by frame.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "encoder/import/coincident.h"

namespace cleft {

using NodePair = std::array<std::int32_t, 2>;

/// Norm of the difference of a field of `components` at two nodes.
double jump_of(const std::vector<double>& values, int components, std::int32_t a, std::int32_t b);

/// For each field the difference below which values count as equal: 1e-9 of its largest value (a vector's or
/// tensor's norm) or, of a scalar, of its range; of fields in single precision, their rounding.
std::vector<double> rounding_of(const Series& series);

/// The field that decides whether a pair is open: the displacement, or the first field.
std::size_t telling_field(const Series& series);

/// The frames from which the values of coincident nodes differ.
struct Partings {
  std::vector<NodePair> pairs;  ///< all within each group, lower node first
  std::vector<std::int32_t>
      first_frame;  ///< of each pair: the first whose jump exceeds rounding; frames: none
};

Partings partings(const Series& series, const Groups& groups,
                  const std::function<void(std::size_t)>& progress = {});

}  // namespace cleft
