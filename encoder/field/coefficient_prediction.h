// The prediction of a coefficient, and the expected distribution of its prediction error. docs/formats.md
// specifies it; integers only.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <vector>

namespace cleft::code {

// Predictions and scales are in units of 1/256 of a quantum.
inline constexpr std::int64_t largest_value = std::int64_t{1} << 40;
inline constexpr std::int64_t largest_input = std::int64_t{1} << 28;
inline constexpr int inputs = 16;

inline std::int32_t limited(std::int64_t x) {
  return static_cast<std::int32_t>(x < -largest_input  ? -largest_input
                                   : x > largest_input ? largest_input
                                                       : x);
}

/// Four levels an octave; x: 4 or more.
inline int log_level(std::int64_t x) {
  const int below =
      61 - std::countl_zero(static_cast<std::uint64_t>(x) | 1);  // binary digits after the first three
  return 4 * below + 4 + static_cast<int>(x >> below);
}

/// From 0 on; scale: 0 or more.
inline int scale_level(std::int64_t scale) { return log_level(scale + 5) - 9; }

/// A slice of one component in one half, with a margin so that every neighbour exists.
template <class T>
class Padded {
 public:
  Padded(int along, int across, int height, T margin)
      : row_(height + 3),
        plane_((across + 3) * row_),
        data_(static_cast<std::size_t>(along + 3) * plane_, margin) {}
  int step_along() const { return plane_; }
  int step_across() const { return row_; }
  int index(int i, int j, int k) const { return (i + 2) * plane_ + (j + 2) * row_ + k + 2; }
  std::size_t size() const { return data_.size(); }
  T* data() { return data_.data(); }

 private:
  int row_, plane_;
  std::vector<T> data_;
};

/// Four inputs, in one register from the start: those stored one by one and then loaded together would wait
/// for each other.
using FourInputs = std::int32_t __attribute__((vector_size(16)));
/// Two adjacent values, and two further ones.
inline FourInputs four_inputs(const std::int32_t* pair, const std::int32_t* another) {
  std::int64_t low, high;
  std::memcpy(&low, pair, sizeof(low)), std::memcpy(&high, another, sizeof(high));
  return std::bit_cast<FourInputs>(std::array{low, high});
}
/// The last may have been stored just now: a load of more than it would wait.
inline FourInputs four_inputs(const std::int32_t* pair, std::int32_t third, std::int32_t last) {
  std::int64_t low;
  std::memcpy(&low, pair, sizeof(low));
  return std::bit_cast<FourInputs>(
      std::array{low, std::int64_t{static_cast<std::uint32_t>(third)} | std::int64_t{last} << 32});
}

/// The inputs of a prediction, divided by 2^shift so that each fits into 12 bits and sums of products are
/// below 2^31.
struct Inputs {
  alignas(16) std::array<std::int16_t, inputs> x;
  int shift;
  std::int64_t inverse;  // 2^36 over the sum of squares and 10 quanta's

  /// The order of the inputs is that of a[0], b[0], a[1], b[1], ..., c[0], d[0], ...
  Inputs(FourInputs a, FourInputs b, FourInputs c, FourInputs d) {
    const FourInputs all = (a ^ (a >> 31)) | (b ^ (b >> 31)) | (c ^ (c >> 31)) | (d ^ (d >> 31));
    const FourInputs two = all | __builtin_shufflevector(all, all, 2, 3, 0, 1);
    shift = static_cast<int>(std::bit_width(static_cast<std::uint32_t>(two[0] | two[1]) | 2048)) - 12;
    const FourInputs pairs[] = {((a >> shift) & 0xFFFF) | (b >> shift) << 16,
                                ((c >> shift) & 0xFFFF) | (d >> shift) << 16};
    std::memcpy(x.data(), pairs, sizeof(pairs));
    inverse = inverse_size();
  }

 private:
  std::int64_t inverse_size() const;
};

/// Normalised least mean squares, with a short memory, so that it follows changes from place to place.
struct LinearPredictor {
  alignas(16) std::array<std::int16_t, inputs> weight{};  // units of 2^-14, at most 1.5
};
/// The mean of the predictions of two of them.
struct TwoPredictions {
  std::int64_t first, second;
};
TwoPredictions predict(const Inputs& in, const LinearPredictor& first, const LinearPredictor& second);
/// rate / 256: the part of the error that is corrected in one step.
void learn(const Inputs& in, std::int64_t error, int rate, LinearPredictor& predictor);

/// Which slices are known when one is coded: halfway between two known ones, the last first.
struct SliceStep {
  int slice, before, after;     // before: -1 the closed state, 0 everywhere; after: -1 none
  int before_that, after_that;  // the next known ones, or -2
};

std::vector<SliceStep> slice_order(int slices);

/// How probable the decisions about a residual are if it has a logistic distribution about the prediction:
/// stretched, by the level of its scale, the prediction's distance from the nearest integer, and the
/// decision.
struct LogisticTable {
  static constexpr int levels = 28, offsets = 17, decisions = 8;  // zero, sign, 3 tails above, 3 below
  std::array<std::int16_t, levels * offsets * decisions> opinion;

  LogisticTable();
  const std::int16_t* at(int level, int offset) const {  // level: 0 or more
    return &opinion[(std::min(level, levels - 1) * offsets + offset) * decisions];
  }
};
extern const LogisticTable logistic;

}  // namespace cleft::code
