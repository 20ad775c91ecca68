// Differences of the values of coincident nodes, frame by frame.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "encoder/import/coincident.h"

namespace cleft {

using NodePair = std::array<std::int32_t, 2>;

/// Norm of the difference of a field of `components` at two nodes.
double jump_of(const std::vector<double>& values, int components, std::int32_t a, std::int32_t b);

/// For each field the difference below which values count as equal: 1e-9 of its largest value (a vector's or
/// tensor's norm) or, of a scalar, of its range; of fields in single precision, their rounding. Means of
/// cells tell nothing, since they differ at coincident nodes that are closed: infinite.
std::vector<double> rounding_of(const ImportedSeries& series);

/// The field that decides whether a pair is open: the displacement, or the first field of the points.
std::size_t telling_field(const ImportedSeries& series);

/// The jump above which a pair is open: in units of the field, or a share of its largest jump.
struct OpenAt {
  double value = 0;
  bool is_share = false;
};

/// "0.002", or "0.5%" of the largest jump. Throws InputError for anything else.
OpenAt parse_open_at(const std::string& text);

/// The frames from which the values of coincident nodes differ.
struct Partings {
  std::vector<NodePair> pairs;  ///< all within each group, lower node first
  std::vector<std::int32_t>
      first_frame;  ///< of each pair: the first whose jump exceeds `open_at`; frames: none
  double open_at = 0, largest_jump = 0;
  std::string because;  ///< why `open_at` is more than rounding; empty if it is not
};

/// Without `given`, `open_at` is rounding (rounding_of), or more where the data say so. Pairs are closed in
/// frame 0: what they jump there is noise. So are jumps that turn around from frame to frame as often as not.
/// Where no pair is ever closed and many are nearly closed, as with cohesive elements, it is 0.5 % of the
/// largest jump. Means of cells jump where all is closed, too: it is twice the largest difference of two
/// corners of a cell.
Partings partings(const ImportedSeries& series, const Groups& groups, const std::optional<OpenAt>& given = {},
                  const std::function<void(std::size_t)>& progress = {});

}  // namespace cleft
