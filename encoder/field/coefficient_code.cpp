#include "encoder/field/coefficient_code.h"

#include <array>
#include <cmath>
#include <cstdlib>

#include "base/error.h"
#include "encoder/field/coefficient_prediction.h"
#include "encoder/field/coefficient_state.h"
#include "encoder/field/range_coder.h"

namespace cleft {

namespace {

using namespace code;

/// The source of the values: a decoder reads them, an encoder has them, and a rounder chooses them.
struct Known {
  std::span<const std::int64_t> values;
};
struct Choice {
  std::span<const double> values;
  double farthest;
};

template <class Coder, class Source>
class Model {
 public:
  Model(Coder& coder, const CoefficientGrid& grid, int slices, const Source& source)
      : coder_(coder), source_(source), slices_(slices), state_(grid, slices) {
    for (auto& half : predictors_)
      for (int first = 0; first < 2; ++first) {
        LinearPredictor start;
        for (const int direct : {3, 6, 7}) start.weight[direct] = first ? 11469 : 5734;       // 0.7, 0.35
        for (const int diagonal : {1, 2, 4}) start.weight[diagonal] = first ? -6554 : -1638;  // -0.4, -0.1
        if (first) start.weight[0] = 3277;                                                    // 0.2
        half[first].assign(static_cast<std::size_t>(state_.width(1)) + 1, start);
      }
    for (auto& mixer : mixers_) mixer.weight = {13107, 13107, 39322};
  }

  std::vector<std::int64_t> run(const std::array<bool, components>& mirrored) {
    for (int c = 0; c < components; ++c) mirrored_[c] = coder_.bit(32768, mirrored[c]);
    for (const SliceStep& step : slice_order(slices_)) {
      for (const int c : component_order)
        for (int half = 0; half < 2; ++half)
          if (half == 1 && mirrored_[c])
            copy_half(step.slice, c);
          else
            code_half(step, c, half);
    }
    return std::move(state_.values);
  }

 private:
  using Place = CoefficientState::Place;
  using Past = CoefficientState::Past;

  void code_half(const SliceStep& step, int c, int half) {
    const Past* known = state_.past(step, c, half).data();
    CoefficientState::Channel& own = state_.channel(half, c);
    const bool between = step.after >= 0;
    const std::ptrdiff_t A = own.innovation.step_along(), B = own.innovation.step_across();
    const std::size_t first = state_.first(c, step.slice);
    auto& predictors = predictors_[half][between ? 0 : 1];
    LinearPredictor& overall = predictors.back();
    std::int32_t* const innovation = own.innovation.data();
    std::int64_t *const error = own.error.data(), *const earlier = own.earlier.data();
    std::int8_t* const residual = own.residual.data();
    for (const Place& place : state_.places(half)) {
      // Neighbours, in the order of memory
      std::int32_t* const d = innovation + place.at;
      const Inputs in(code::four_inputs(d - A - B - 1, d - A - 1), code::four_inputs(d - B - 1, d[-2], d[-1]),
                      FourInputs{d[-B + 1], d[-2 * A], known->near_innovation, known->far_innovation},
                      known->inputs);
      LinearPredictor& local = predictors[place.across];
      const auto [one, two] = code::predict(in, overall, local);
      const std::int64_t prediction = known->base + ((one + two) >> 1);

      std::int64_t* const e = error + place.at;
      std::int64_t* const p = earlier + place.at;
      const std::int64_t direct = e[-A] + e[-B] + e[-1];
      const std::int64_t diagonal = e[-A - B] + e[-A - 1] + e[-B - 1] + e[-A + B] + e[-A + 1] + e[-B + 1];
      const std::int64_t behind = p[-A] + p[-B] + p[-1];
      std::int8_t* const r = residual + place.at;
      const std::int64_t found = code_value(
          {prediction, (4 * direct + diagonal + behind + known->spread) >> 5, direct * 85 >> 8,
           (known->here + ((known->ahead + behind) * 43 >> 8)) >> 1, (r[-A] * 5 + r[-B]) * 5 + r[-1]},
          first + place.unknown);

      const std::int64_t target = 256 * found;
      learn(in, limited(target - known->base - one), 160, overall);
      learn(in, limited(target - known->base - two), 70, local);
      *d = limited(target - known->base);
      const std::int32_t size = std::abs(limited(target - prediction));
      *e = size;
      *p = between ? (size + *p) >> 1 : size >> 1;
      *r = static_cast<std::int8_t>(2 + std::clamp<std::int64_t>(found - ((prediction + 128) >> 8), -2, 2));
      ++known;
    }
  }

  struct Expectation {
    std::int64_t prediction, scale, near, earlier;
    int residuals;  // of three neighbours, 5 values each
  };

  /// The value itself: its distance from the prediction, decision after decision.
  std::int64_t code_value(const Expectation& expected, std::size_t at) {
    const std::int64_t nearest = (expected.prediction + 128) >> 8;
    std::int64_t offset = expected.prediction - 256 * nearest;  // -128 .. 127
    const bool flipped = offset < 0;
    if (flipped) offset = -offset;
    // Where the scale is large, bins of 2^coarse integers, and plain bits for the place in the bin.
    const int coarse =
        static_cast<int>(std::bit_width(static_cast<std::uint64_t>(expected.scale) | 512)) - 10;
    const int level = scale_level(expected.scale >> coarse);
    offset >>= coarse;

    std::int64_t distance = 0;
    if constexpr (!Coder::decodes) {
      distance = wanted(at, nearest);
      if (flipped) distance = -distance;
    }
    const std::int64_t half_bin = (std::int64_t{1} << coarse) >> 1;
    const std::int64_t bin = (distance + half_bin) >> coarse;

    const int quarter = static_cast<int>(offset) >> 5;  // 0 .. 4
    const auto part = [](std::int64_t x) { return std::min(scale_level(x) * 3 >> 3, 11); };
    const int first = ((part(expected.near) * 12 + part(expected.earlier)) * 5 + quarter) * 16;
    const int second =
        ((flipped ? 124 - expected.residuals : expected.residuals) * 8 + std::min(level >> 2, 7)) * 16;
    const int selected = std::min(level * 3 >> 3, 15);
    const std::int16_t* opinion =
        logistic.at(log_level((expected.scale >> coarse) + 13) - 12, static_cast<int>(offset) >> 3);
    Chance* const firsts = &first_[first];
    Chance* const seconds = &second_[second];
    Mixer<3>* const mixers = &mixers_[selected];
    const auto decide = [&](int decision, int kind, int wanted_bit) {
      Chance& a = firsts[decision];
      Chance& b = seconds[decision];
      const int bit = mixers[decision * 16].code(
          coder_, std::array<int, 3>{code::stretch(a.p), code::stretch(b.p), opinion[kind]}, wanted_bit);
      a.learn(bit, 255), b.learn(bit, 255);
      return bit;
    };
    std::int64_t found_bin = 0;
    if (decide(0, 0, bin != 0)) {
      const int negative = decide(1, 1, bin < 0);
      const std::int64_t beyond = std::abs(bin) - 1;
      std::int64_t more = 0;
      while (more < 20 &&
             decide((negative ? 9 : 2) + std::min<int>(static_cast<int>(more), 6),
                    (negative ? 5 : 2) + std::min<int>(static_cast<int>(more), 2), beyond > more))
        ++more;
      if (more == 20) [[unlikely]]
        more += static_cast<std::int64_t>(code::code_plain(coder_, static_cast<std::uint64_t>(beyond - 20)));
      if (more > 4 * largest_value) throw InputError("a coded number is too large");
      found_bin = negative ? -more - 1 : more + 1;
    }
    std::int64_t found = found_bin << coarse;
    if (coarse > 0) [[unlikely]] {
      std::int64_t low = distance + half_bin - found, read = 0;
      for (int bit = coarse - 1; bit >= 0; --bit)
        read = read << 1 | coder_.bit(32768, static_cast<int>(low >> bit & 1));
      found += read - half_bin;
    }
    return keep(at, nearest + (flipped ? -found : found));
  }

  std::int64_t keep(std::size_t at, std::int64_t found) {
    if (static_cast<std::uint64_t>(found + largest_value) > 2 * largest_value)
      throw InputError("a coded number is too large");
    return state_.values[at] = found;
  }

  /// The distance of the value to be coded from `nearest`.
  std::int64_t wanted(std::size_t at, std::int64_t nearest) const {
    if constexpr (std::is_same_v<Source, Choice>) {
      // Away from the nearest integer toward the prediction, where that costs little.
      const double exact = source_.values[at] - static_cast<double>(nearest);
      const auto rounded = static_cast<std::int64_t>(std::llround(exact));
      std::int64_t best = rounded;
      double least = HUGE_VAL;
      for (std::int64_t candidate = std::abs(rounded);
           candidate >= std::max<std::int64_t>(0, std::abs(rounded) - 1); --candidate) {
        const std::int64_t signed_candidate = rounded < 0 ? -candidate : candidate;
        const double error = std::abs(exact - static_cast<double>(signed_candidate));
        if (error > source_.farthest && candidate != std::abs(rounded)) continue;
        const double cost =
            error * error + 0.1 * (candidate == 0 ? 0 : 1 + 1.5 * static_cast<double>(candidate));
        if (cost < least) least = cost, best = signed_candidate;
      }
      return best;
    } else {
      return source_.values[at] - nearest;
    }
  }

  /// The second half if it mirrors the first: one decision for each value confirms it.
  void copy_half(int slice, int c) {
    const std::size_t first = state_.first(c, slice);
    const std::int64_t sign = c == 1 ? -1 : 1;
    Chance differs = differs_[c];  // in a register
    for (const Place& place : state_.places(1)) {
      const std::int64_t mirror = place.twin < 0 ? 0 : sign * state_.values[first + place.twin];
      std::int64_t distance = 0;
      if constexpr (!Coder::decodes) distance = copied(first + place.unknown, mirror);
      if (code::code_bit(coder_, differs, distance != 0, 1023)) [[unlikely]] {
        const bool negative = coder_.bit(32768, distance < 0);
        const auto beyond = static_cast<std::int64_t>(
            code::code_plain(coder_, static_cast<std::uint64_t>(std::abs(distance) - 1)));
        distance = negative ? -beyond - 1 : beyond + 1;
      } else
        distance = 0;
      keep(first + place.unknown, mirror + distance);
    }
    differs_[c] = differs;
  }

  std::int64_t copied(std::size_t at, std::int64_t mirror) const {
    if constexpr (std::is_same_v<Source, Choice>) {
      if (std::abs(source_.values[at] - static_cast<double>(mirror)) <= source_.farthest + 1e-6) return 0;
      return static_cast<std::int64_t>(std::llround(source_.values[at])) - mirror;
    } else {
      return wanted(at, mirror);
    }
  }

  Coder& coder_;
  Source source_;
  int slices_;
  CoefficientState state_;
  std::array<bool, components> mirrored_{};
  std::array<std::array<std::vector<LinearPredictor>, 2>, 2> predictors_;  // by half; between slices or not
  std::vector<Chance> first_ = std::vector<Chance>(12 * 12 * 5 * 16);
  std::vector<Chance> second_ = std::vector<Chance>(125 * 8 * 16);
  std::array<Mixer<3>, 16 * 16> mixers_;
  std::array<Chance, components> differs_;
};

/// Of each component, whether its second half mirrors the first at nearly all places.
template <class T>
std::array<bool, components> mirror_images(const CoefficientGrid& grid, int slices, std::span<const T> values,
                                           double tolerance) {
  std::array<bool, components> result;
  for (int c = 0; c < components; ++c) {
    std::size_t pairs = 0, unlike = 0;
    for (int l = 0; l < slices; ++l) {
      const auto slice = values.subspan((static_cast<std::size_t>(c) * slices + l) * grid.unknowns);
      for (int i = 0; i < grid.along; ++i)
        for (int j = 0; j < grid.across / 2; ++j)
          for (int k = 0; k < grid.height; ++k) {
            const auto at = [&](int column) {
              return grid.unknown[(static_cast<std::size_t>(i) * grid.across + column) * grid.height + k];
            };
            const int left = at(j), right = at(grid.across - 1 - j);
            if (left < 0 || right < 0) continue;
            ++pairs;
            const auto difference = c == 1 ? slice[left] + slice[right] : slice[left] - slice[right];
            unlike += std::abs(static_cast<double>(difference)) > tolerance;
          }
    }
    result[c] = 8 * unlike < pairs;
  }
  return result;
}

std::size_t checked_size(const CoefficientGrid& grid, int slices) {
  CLEFT_CHECK(grid.unknown.size(), ==, static_cast<std::size_t>(grid.along) * grid.across * grid.height);
  return static_cast<std::size_t>(components) * slices * grid.unknowns;
}

}  // namespace

std::vector<std::uint8_t> encode_coefficients(const CoefficientGrid& grid, int slices,
                                              std::span<const std::int64_t> values) {
  CLEFT_CHECK(values.size(), ==, checked_size(grid, slices));
  code::Encoder coder;
  Model(coder, grid, slices, Known{values}).run(mirror_images(grid, slices, values, 0));
  return coder.finish();
}

std::vector<std::int64_t> decode_coefficients(const CoefficientGrid& grid, int slices,
                                              std::span<const std::uint8_t> bytes) {
  checked_size(grid, slices);
  code::Decoder coder(bytes);
  auto values = Model(coder, grid, slices, Known{}).run({});
  coder.finish();
  return values;
}

std::vector<std::int64_t> round_coefficients(const CoefficientGrid& grid, int slices,
                                             std::span<const double> values, double farthest) {
  CLEFT_CHECK(values.size(), ==, checked_size(grid, slices));
  code::Encoder coder;
  return Model(coder, grid, slices, Choice{values, farthest}).run(mirror_images(grid, slices, values, 1e-3));
}

}  // namespace cleft
