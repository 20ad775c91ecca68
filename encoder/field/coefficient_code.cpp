#include "encoder/field/coefficient_code.h"

#include <array>
#include <cmath>
#include <cstdlib>

#include "base/error.h"
#include "encoder/field/coefficient_prediction.h"
#include "encoder/field/range_coder.h"

namespace cleft {

namespace {

using namespace code;

constexpr int components = 3;
constexpr std::array<int, components> component_order = {1, 2, 0};  // across the cut first: it moves most
constexpr std::int32_t unknown_error = 77;                          // 0.3, where nothing is known

/// Where the values come from: a decoder has none, an encoder knows them, and a rounder chooses among some.
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
      : coder_(coder),
        grid_(grid),
        slices_(slices),
        source_(source),
        values_(static_cast<std::size_t>(components) * slices * grid.unknowns),
        width_{grid.across / 2, grid.across - grid.across / 2} {
    for (int half = 0; half < 2; ++half)
      for (int c = 0; c < components; ++c) channels_[half].emplace_back(grid, width_[half]);
    for (auto& half : predictors_)
      for (int first = 0; first < 2; ++first) {
        LinearPredictor start;
        for (int n = 0; n < 3; ++n) {
          start.weight[n] = first ? 11469 : 5734;       // 0.7, 0.35
          start.weight[3 + n] = first ? -6554 : -1638;  // -0.4, -0.1
        }
        if (first) start.weight[6] = 3277;  // 0.2
        half[first].assign(static_cast<std::size_t>(width_[1]) + 1, start);
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
    return std::move(values_);
  }

 private:
  struct Channel {
    Padded<std::int32_t> innovation;  // from the interpolation in t, of this slice
    Padded<std::int32_t> error;       // of the prediction, of this slice: its size
    Padded<std::int32_t> earlier;     // the same, of slices before
    Padded<std::int8_t> residual;     // -2 .. 2
    Channel(const CoefficientGrid& g, int width)
        : innovation(g.along, width, g.height, 0),
          error(g.along, width, g.height, unknown_error),
          earlier(g.along, width, g.height, unknown_error),
          residual(g.along, width, g.height, 0) {}
  };

  std::int64_t& value(int c, int slice, int unknown) {
    return values_[(static_cast<std::size_t>(c) * slices_ + slice) * grid_.unknowns + unknown];
  }
  int column(int half, int j) const { return half == 0 ? j : grid_.across - 1 - j; }
  int unknown_at(int i, int column, int k) const {
    return grid_.unknown[(static_cast<std::size_t>(i) * grid_.across + column) * grid_.height + k];
  }

  void code_half(const SliceStep& step, int c, int half) {
    Channel& own = channels_[half][c];
    const int rank = c == 1 ? 0 : c == 2 ? 1 : 2;
    const bool between = step.after >= 0;
    const std::int64_t toward_after =
        between ? ((2 * 65536LL * (step.slice - step.before)) / (step.after - step.before) + 1) / 2 : 0;
    const std::int64_t per_step = between ? 65536 / (step.after - step.before) : 0,
                       per_step_before =
                           step.before_that != -2 ? 65536 / (step.before - step.before_that) : 0,
                       per_step_after = step.after_that != -2 ? 65536 / (step.after_that - step.after) : 0;
    const int A = own.innovation.step_along(), B = own.innovation.step_across();
    // The components coded before this one in this slice, the later first; and the other half's.
    const Channel* before[2] = {rank > 0 ? &channels_[half][component_order[rank - 1]] : nullptr,
                                rank > 1 ? &channels_[half][component_order[0]] : nullptr};
    const Padded<std::int32_t>& near_error =
        rank > 0 ? before[0]->error : channels_[half][component_order[2]].earlier;
    const Padded<std::int32_t>& far_error =
        rank > 1 ? before[1]->error : channels_[half][component_order[2]].earlier;
    const int other_width = width_[0];
    std::array<std::int32_t, inputs> x{};
    for (int i = 0; i < grid_.along; ++i)
      for (int j = 0; j < width_[half]; ++j)
        for (int k = 0; k < grid_.height; ++k) {
          const int unknown = unknown_at(i, column(half, j), k);
          if (unknown < 0) continue;
          const int at = own.innovation.index(i, j, k);
          const auto of = [&](int slice) { return slice < 0 ? 0 : value(c, slice, unknown); };
          const std::int64_t from = of(step.before), to = between ? of(step.after) : 0;
          const std::int64_t base = between ? (from * (65536 - toward_after) + to * toward_after) >> 8 : 0;

          const std::int32_t* d = own.innovation.at(at);
          x[0] = d[-A], x[1] = d[-B], x[2] = d[-1];
          x[3] = d[-A - B], x[4] = d[-A - 1], x[5] = d[-B - 1], x[6] = d[-A - B - 1];
          x[7] = d[-2 * A], x[8] = d[-2], x[9] = d[-B + 1];
          x[10] = before[0] ? *before[0]->innovation.at(at) : 0;
          x[11] = before[1] ? *before[1]->innovation.at(at) : 0;
          // Differences of the slices' slopes in t
          if (between) {
            const std::int64_t slope = (to - from) * per_step;
            x[12] = limited((to - from) * 64);
            if (step.before_that != -2)
              x[13] = limited(((from - of(step.before_that)) * per_step_before - slope) >> 8);
            if (step.after_that != -2)
              x[14] = limited(((of(step.after_that) - to) * per_step_after - slope) >> 8);
          }
          x[15] = half == 1 && j < other_width
                      ? (c == 1 ? -1 : 1) *
                            *channels_[0][c].innovation.at(channels_[0][c].innovation.index(i, j, k))
                      : 0;

          const Inputs in(x);
          LinearPredictor& overall = predictors_[half][between ? 0 : 1].back();
          LinearPredictor& local = predictors_[half][between ? 0 : 1][j];
          const std::int64_t one = overall(in), two = local(in);
          const std::int64_t prediction = base + ((one + two) >> 1);

          const std::int32_t* e = own.error.at(at);
          const std::int32_t* p = own.earlier.at(at);
          const std::int64_t direct = static_cast<std::int64_t>(e[-A]) + e[-B] + e[-1];
          const std::int64_t diagonal = static_cast<std::int64_t>(e[-A - B]) + e[-A - 1] + e[-B - 1] +
                                        e[-A + B] + e[-A + 1] + e[-B + 1];
          const std::int64_t around = static_cast<std::int64_t>(p[A]) + p[B] + p[1] + p[-A] + p[-B] + p[-1];
          const std::int64_t scale = (4 * direct + diagonal + 3LL * p[0] + 3LL * *near_error.at(at) +
                                      2LL * *far_error.at(at) + around) >>
                                     5;
          const std::int8_t* r = own.residual.at(at);
          const std::int64_t found = code_value(
              {prediction, scale, direct * 85 >> 8, (p[0] + (around * 43 >> 8)) >> 1, {r[-A], r[-B], r[-1]}},
              c, step.slice, unknown);

          const std::int64_t target = 256 * found;
          overall.learn(in, limited(target - base - one), 160);
          local.learn(in, limited(target - base - two), 70);
          own.innovation[at] = limited(target - base);
          const std::int32_t size = std::abs(limited(target - prediction));
          own.error[at] = size;
          own.earlier[at] = between ? (size + own.earlier[at]) >> 1 : size >> 1;
          own.residual[at] =
              static_cast<std::int8_t>(std::clamp<std::int64_t>(found - ((prediction + 128) >> 8), -2, 2));
        }
  }

  struct Expectation {
    std::int64_t prediction, scale, near, earlier;
    std::array<std::int8_t, 3> residuals;
  };

  /// The value itself: its distance from the prediction, decision after decision.
  std::int64_t code_value(const Expectation& expected, int c, int slice, int unknown) {
    const std::int64_t nearest = (expected.prediction + 128) >> 8;
    std::int64_t offset = expected.prediction - 256 * nearest;  // -128 .. 127
    const bool flipped = offset < 0;
    if (flipped) offset = -offset;
    // Where the scale is large, bins of 2^coarse integers, and plain bits for the place in the bin.
    const int coarse =
        std::max(0, static_cast<int>(std::bit_width(static_cast<std::uint64_t>(expected.scale))) - 10);
    const int level = scale_level(expected.scale >> coarse);
    offset >>= coarse;

    std::int64_t distance = 0;
    if constexpr (!Coder::decodes) {
      distance = wanted(c, slice, unknown, nearest);
      if (flipped) distance = -distance;
    }
    const std::int64_t half_bin = coarse > 0 ? std::int64_t{1} << (coarse - 1) : 0;
    const std::int64_t bin = (distance + half_bin) >> coarse;

    const int quarter = static_cast<int>(offset) >> 5;  // 0 .. 4
    const auto part = [](std::int64_t x) { return std::clamp(scale_level(x) * 3 / 8, 0, 11); };
    const auto code_of = [&](int r) { return (flipped ? -r : r) + 2; };
    const int first = ((part(expected.near) * 12 + part(expected.earlier)) * 5 + quarter) * 16;
    const int second = (((code_of(expected.residuals[0]) * 5 + code_of(expected.residuals[1])) * 5 +
                         code_of(expected.residuals[2])) *
                            8 +
                        std::clamp(level / 4, 0, 7)) *
                       16;
    const int selected = std::clamp(level * 3 / 8, 0, 15);
    const std::int16_t* opinion =
        logistic.at(log_level((expected.scale >> coarse) + 13) - 12, static_cast<int>(offset) >> 3);
    const auto decide = [&](int decision, int kind, int wanted_bit) {
      Chance& a = first_[first + decision];
      Chance& b = second_[second + decision];
      const int bit = mixers_[decision * 16 + selected].code(
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
      if (more == 20)
        more += static_cast<std::int64_t>(code::code_plain(coder_, static_cast<std::uint64_t>(beyond - 20)));
      if (more > 4 * largest_value) throw InputError("a coded number is too large");
      found_bin = negative ? -more - 1 : more + 1;
    }
    std::int64_t found = found_bin << coarse;
    if (coarse > 0) {
      std::int64_t low = distance + half_bin - found, read = 0;
      for (int bit = coarse - 1; bit >= 0; --bit)
        read = read << 1 | coder_.bit(32768, static_cast<int>(low >> bit & 1));
      found += read - half_bin;
    }
    return keep(c, slice, unknown, nearest + (flipped ? -found : found));
  }

  std::int64_t keep(int c, int slice, int unknown, std::int64_t found) {
    if (found > largest_value || found < -largest_value) throw InputError("a coded number is too large");
    return value(c, slice, unknown) = found;
  }

  /// The distance of the value to be coded from `nearest`.
  std::int64_t wanted(int c, int slice, int unknown, std::int64_t nearest) const {
    const std::size_t at = (static_cast<std::size_t>(c) * slices_ + slice) * grid_.unknowns + unknown;
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

  /// The second half where it mirrors the first: one decision a value says that it does.
  void copy_half(int slice, int c) {
    for (int i = 0; i < grid_.along; ++i)
      for (int j = 0; j < width_[1]; ++j)
        for (int k = 0; k < grid_.height; ++k) {
          const int unknown = unknown_at(i, column(1, j), k);
          if (unknown < 0) continue;
          const int twin = j < width_[0] ? unknown_at(i, j, k) : -1;
          const std::int64_t mirror = twin < 0 ? 0 : (c == 1 ? -1 : 1) * value(c, slice, twin);
          std::int64_t distance = 0;
          if constexpr (!Coder::decodes) distance = copied(c, slice, unknown, mirror);
          if (code::code_bit(coder_, differs_[c], distance != 0, 1023)) {
            const bool negative = coder_.bit(32768, distance < 0);
            const auto beyond = static_cast<std::int64_t>(
                code::code_plain(coder_, static_cast<std::uint64_t>(std::abs(distance) - 1)));
            distance = negative ? -beyond - 1 : beyond + 1;
          } else
            distance = 0;
          keep(c, slice, unknown, mirror + distance);
        }
  }

  std::int64_t copied(int c, int slice, int unknown, std::int64_t mirror) const {
    if constexpr (std::is_same_v<Source, Choice>) {
      const std::size_t at = (static_cast<std::size_t>(c) * slices_ + slice) * grid_.unknowns + unknown;
      if (std::abs(source_.values[at] - static_cast<double>(mirror)) <= source_.farthest + 1e-6) return 0;
      return static_cast<std::int64_t>(std::llround(source_.values[at])) - mirror;
    } else {
      return wanted(c, slice, unknown, mirror);
    }
  }

  Coder& coder_;
  const CoefficientGrid& grid_;
  int slices_;
  Source source_;
  std::vector<std::int64_t> values_;
  std::array<int, 2> width_;
  std::array<bool, components> mirrored_{};
  std::array<std::vector<Channel>, 2> channels_;
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
