// Lossless coding of a field's quantised coefficients, and rounding to integers that need few bytes.
// docs/formats.md specifies the bytes.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace cleft {

/// The places of the unknowns on the grid of control points along, across and in height.
struct CoefficientGrid {
  int along = 0, across = 0, height = 0;
  std::vector<std::int32_t> unknown;  ///< of place (i across + j) height + k; -1: a place without one
  int unknowns = 0;                   ///< each is at one place
};

/// Values are numbered (component * slices + slice) * unknowns + unknown: three components, and slices of
/// control points in t. The values may be anything from -2^40 to 2^40 (InputError beyond); smooth values, and
/// values that are even or odd across the middle (each component separately), need few bytes.
std::vector<std::uint8_t> encode_coefficients(const CoefficientGrid& grid, int slices,
                                              std::span<const std::int64_t> values);

/// Throws InputError if the bytes are detectably not an output of encode_coefficients() for this grid.
std::vector<std::int64_t> decode_coefficients(const CoefficientGrid& grid, int slices,
                                              std::span<const std::uint8_t> bytes);

/// Rounds values to integers that need about a tenth fewer bytes than the nearest ones at the same error.
/// None is further away than `farthest`, 0.5 (the nearest) to 1.
std::vector<std::int64_t> round_coefficients(const CoefficientGrid& grid, int slices,
                                             std::span<const double> values, double farthest);

}  // namespace cleft
