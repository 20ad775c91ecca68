// The state of coding a field's quantised coefficients: the values that are coded already, and the errors of
// their predictions.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "encoder/field/coefficient_code.h"
#include "encoder/field/coefficient_prediction.h"

namespace cleft::code {

inline constexpr int components = 3;
inline constexpr std::array<int, components> component_order = {1, 2,
                                                                0};  // across the cut first: it moves most

class CoefficientState {
 public:
  CoefficientState(const CoefficientGrid& grid, int slices);

  struct Channel {
    Padded<std::int32_t> innovation;  // from the interpolation in t, of this slice
    Padded<std::int64_t> error;       // of the prediction, of this slice: its size
    Padded<std::int64_t> earlier;     // the same, of slices before
    Padded<std::int8_t> residual;     // -2 .. 2, plus 2
    Channel(const CoefficientGrid& grid, int width);
  };
  /// An unknown of one half, in the order of coding.
  struct Place {
    std::int32_t at;  // in a channel's arrays
    std::int32_t unknown, across;
    std::int32_t twin;  // the unknown at the mirrored place, or -1
  };
  /// The contributions of earlier slices and components to the prediction of a value.
  struct Past {
    FourInputs inputs;         // differences of the slices' slopes in t, and the other half's innovation
    std::int64_t base;         // interpolated in t
    std::int64_t spread;       // part of the scale
    std::int64_t ahead, here;  // sizes of the errors of slices before, in the places to come and in this one
    std::int32_t near_innovation, far_innovation;
  };

  /// The number of a slice's first value.
  std::size_t first(int c, int slice) const {
    return (static_cast<std::size_t>(c) * slices_ + slice) * grid_.unknowns;
  }
  /// Prepares these for all places of the slice and component that are coded next, together for speed.
  const std::vector<Past>& past(const SliceStep& step, int c, int half);

  int width(int half) const { return width_[half]; }
  const std::vector<Place>& places(int half) const { return places_[half]; }
  Channel& channel(int half, int c) { return channels_[half][c]; }

  std::vector<std::int64_t> values;

 private:
  const std::int64_t* slice_values(int c, int slice) const;
  std::vector<Place> places_of(int half) const;

  const CoefficientGrid& grid_;
  int slices_;
  std::array<int, 2> width_;
  std::array<std::vector<Channel>, 2>
      channels_;  // of both halves alike, so that a place and its mirror are one
  std::array<std::vector<Place>, 2> places_;
  std::vector<Past> past_;
  std::vector<std::int64_t> closed_;   // a slice of zeros
  std::vector<std::int32_t> nothing_;  // a channel of zeros
};

}  // namespace cleft::code
