#include "encoder/field/coefficient_code.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "base/error.h"
#include "encoder/field/range_coder.h"

namespace cleft {

namespace {

/// Every place an unknown, but for some of the middle columns where `holes` is set.
CoefficientGrid grid_of(int along, int across, int height, bool holes = false) {
  CoefficientGrid grid{along, across, height, {}, 0};
  for (int i = 0; i < along; ++i)
    for (int j = 0; j < across; ++j)
      for (int k = 0; k < height; ++k) {
        const bool hole = holes && (j == across / 2 || (j == across / 2 - 1 && i < 2));
        grid.unknown.push_back(hole ? -1 : grid.unknowns++);
      }
  return grid;
}

using Values = std::vector<std::int64_t>;

/// A field that grows with the cut next to a plane that it opens, quantised; `skew` breaks the symmetry.
std::vector<double> opening(const CoefficientGrid& grid, int slices, double size, double skew) {
  std::vector<double> values(static_cast<std::size_t>(3) * slices * grid.unknowns);
  for (int i = 0; i < grid.along; ++i)
    for (int j = 0; j < grid.across; ++j)
      for (int k = 0; k < grid.height; ++k) {
        const int unknown = grid.unknown[(i * grid.across + j) * grid.height + k];
        if (unknown < 0) continue;
        const double u = (i + 0.5) / grid.along - 0.5, v = 2 * (j + 0.5) / grid.across - 1,
                     w = (k + 1.) / grid.height;
        for (int l = 0; l < slices; ++l) {
          const double t = (l + 1.) / slices,
                       near = size * w * std::exp(-3 * std::abs(v) - 8 * u * u / (t + 0.1)) * t;
          const double bent = 1 + skew * v;
          const std::size_t at = static_cast<std::size_t>(l) * grid.unknowns + unknown,
                            next = static_cast<std::size_t>(slices) * grid.unknowns;
          values[at] = u * near * bent;
          values[at + next] = (v < 0 ? -1 : 1) * near * bent;
          values[at + 2 * next] = 0.5 * near * near / size * bent;
        }
      }
  return values;
}

Values rounded(const std::vector<double>& values) {
  Values result;
  for (const double x : values) result.push_back(std::llround(x));
  return result;
}

/// The bytes, having read them back.
std::vector<std::uint8_t> coded(const CoefficientGrid& grid, int slices, const Values& values) {
  const auto bytes = encode_coefficients(grid, slices, values);
  EXPECT_EQ(decode_coefficients(grid, slices, bytes), values);
  return bytes;
}

Values random_values(std::size_t count, std::int64_t largest, unsigned seed) {
  std::mt19937_64 random(seed);
  Values values(count);
  for (auto& x : values) x = static_cast<std::int64_t>(random() % (2 * largest + 1)) - largest;
  return values;
}

}  // namespace

TEST(CoefficientCode, GivesBackWhatItWasGiven) {
  for (const bool holes : {false, true})
    for (const auto [along, across, height, slices] :
         {std::array{7, 8, 5, 6}, {1, 1, 1, 1}, {3, 5, 2, 2}, {2, 7, 1, 13}, {1, 2, 9, 1}}) {
      const CoefficientGrid grid = grid_of(along, across, height, holes);
      const std::size_t count = static_cast<std::size_t>(3) * slices * grid.unknowns;
      for (const std::int64_t largest : {1LL, 3LL, 100LL, 70000LL, 1LL << 31, 1LL << 40})
        coded(grid, slices, random_values(count, largest, static_cast<unsigned>(largest % 97)));
      Values spikes(count, 0);
      for (std::size_t n = 0; n < count; n += 17) spikes[n] = n % 2 ? 1LL << 40 : -(1LL << 40);
      coded(grid, slices, spikes);
    }
}

TEST(CoefficientCode, NothingCostsNothing) {
  EXPECT_LE(coded(grid_of(4, 4, 4), 0, {}).size(), 1u);
  EXPECT_LE(coded(grid_of(0, 4, 4), 3, {}).size(), 1u);
  const CoefficientGrid grid = grid_of(18, 14, 9, true);
  EXPECT_LE(coded(grid, 12, Values(static_cast<std::size_t>(3) * 12 * grid.unknowns, 0)).size(), 24u);
}

TEST(CoefficientCode, SmoothValuesCostAFractionOfABitPerDigit) {
  const CoefficientGrid grid = grid_of(18, 14, 9);
  const auto values = rounded(opening(grid, 12, 200, 0.3));
  EXPECT_LT(8. * static_cast<double>(coded(grid, 12, values).size()) / static_cast<double>(values.size()),
            1.);
}

TEST(CoefficientCode, ValuesThatMirrorEachOtherCostHalf) {
  const CoefficientGrid grid = grid_of(18, 14, 9);
  Values even = rounded(opening(grid, 12, 400, 0));
  const std::size_t whole = coded(grid, 12, rounded(opening(grid, 12, 400, 0.3))).size();
  const std::size_t mirrored = coded(grid, 12, even).size();
  EXPECT_LT(static_cast<double>(mirrored), 0.56 * static_cast<double>(whole));
  // A few that do not cost a few bytes each.
  for (std::size_t n = 11; n < even.size(); n += even.size() / 10) even[n] += 3;
  EXPECT_LT(coded(grid, 12, even).size(), mirrored + 60);
}

TEST(CoefficientCode, RoundingThatCostsLessStaysNear) {
  const CoefficientGrid grid = grid_of(18, 14, 9, true);
  const auto values = opening(grid, 12, 300, 0.2);
  for (const double farthest : {0.5, 0.6, 0.8}) {
    const Values found = round_coefficients(grid, 12, values, farthest);
    for (std::size_t n = 0; n < values.size(); ++n)
      ASSERT_LE(std::abs(values[n] - static_cast<double>(found[n])), farthest + 1e-5) << n;
  }
  EXPECT_EQ(round_coefficients(grid, 12, values, 0.5), rounded(values));
  EXPECT_LT(static_cast<double>(coded(grid, 12, round_coefficients(grid, 12, values, 0.65)).size()),
            0.95 * static_cast<double>(coded(grid, 12, rounded(values)).size()));
}

TEST(CoefficientCode, DamagedBytesNeverDoMoreThanThrowOrGiveOtherValues) {
  const CoefficientGrid grid = grid_of(9, 8, 5, true);
  const auto values = random_values(static_cast<std::size_t>(3) * 7 * grid.unknowns, 20, 5);
  const auto bytes = coded(grid, 7, values);
  int thrown = 0;
  const auto attempt = [&](const std::vector<std::uint8_t>& damaged) {
    try {
      for (const std::int64_t x : decode_coefficients(grid, 7, damaged)) ASSERT_LE(std::abs(x), 1LL << 40);
    } catch (const InputError&) {
      ++thrown;
    }
  };
  std::mt19937 random(3);
  for (int n = 0; n < 60; ++n) {
    auto damaged = bytes;
    damaged[random() % damaged.size()] ^= static_cast<std::uint8_t>(1 << random() % 8);
    attempt(damaged);
    for (auto& byte : damaged) byte = static_cast<std::uint8_t>(n < 2 ? 255 * n : random());
    attempt(damaged);
  }
  const int of_flips = thrown;
  EXPECT_GT(of_flips, 20);
  for (std::size_t size = 0; size + 8 < bytes.size(); size += 97) {
    attempt({bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size)});
    EXPECT_EQ(thrown, of_flips + 1 + static_cast<int>(size / 97)) << "cut to " << size;
  }
  auto longer = bytes;
  longer.insert(longer.end(), 9, 1);
  EXPECT_THROW(decode_coefficients(grid, 7, longer), InputError);
}

TEST(CoefficientCode, GivesTheSameBytesOnEveryMachine) {
  const CoefficientGrid grid = grid_of(8, 8, 5, true);
  Values values(static_cast<std::size_t>(3) * 6 * grid.unknowns);
  std::uint64_t state = 1;
  for (std::size_t n = 0; n < values.size(); ++n) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    const auto at = static_cast<std::int64_t>(n % grid.unknowns);
    values[n] = at * at / 9 - 3 * at + static_cast<std::int64_t>(state >> 60) * (n % 7 == 0);
  }
  std::uint64_t hash = 14695981039346656037u;
  for (const std::uint8_t byte : coded(grid, 6, values)) hash = (hash ^ byte) * 1099511628211u;
  EXPECT_EQ(hash, 13855951805055881598u);
}

TEST(CoefficientCode, LargerNumbersThanTheFormatHasAreRefused) {
  const CoefficientGrid grid = grid_of(2, 2, 2);
  Values values(static_cast<std::size_t>(3) * grid.unknowns, 0);
  for (const std::int64_t sign : {-1, 1}) {
    values[5] = sign * (1LL << 40);
    coded(grid, 1, values);
    values[5] += sign;
    EXPECT_THROW(encode_coefficients(grid, 1, values), InputError);
  }
}

TEST(RangeCoder, ANumberWithoutEndIsRefused) {
  code::Encoder encoder;
  for (int n = 0; n < 200; ++n) encoder.bit(32768, n < 100);
  const auto bytes = encoder.finish();
  code::Decoder decoder(bytes);
  EXPECT_THROW(code::code_plain(decoder, 0), InputError);
}

TEST(RangeCoder, TablesDoNotHangOnTheLastDigitsOfALibrary) {
  const auto clear = [](double x) { return std::abs(x - std::floor(x) - 0.5) > 1e-6; };
  for (int p = 0; p < 4096; ++p) EXPECT_TRUE(clear(256 * std::log((p + 0.5) / (4095.5 - p)))) << p;
  for (int x = -code::farthest; x <= code::farthest; ++x)
    EXPECT_TRUE(clear(65536 / (1 + std::exp(-x / 256.)))) << x;
  // Both against numbers from elsewhere: ln 3 = 1.0986, 1 / (1 + e^-1) = 0.73106.
  EXPECT_EQ(code::stretch(49152), 281);
  EXPECT_EQ(code::squash(256), 47911);
}

TEST(RangeCoder, EveryByteSequenceEndsWhereItsWriterEnded) {
  std::mt19937 random(9);
  for (int round = 0; round < 2000; ++round) {
    const int count = static_cast<int>(random() % 40);
    std::vector<std::array<int, 2>> bits;
    for (int n = 0; n < count; ++n) {
      const int p = round % 3 == 0 ? 4 : round % 3 == 1 ? 65532 : static_cast<int>(random() % 65529) + 4;
      bits.push_back({p, static_cast<int>(random() % 65536) < p});
    }
    code::Encoder encoder;
    for (const auto& [p, bit] : bits) encoder.bit(p, bit);
    const auto bytes = encoder.finish();
    code::Decoder decoder(bytes);
    for (const auto& [p, bit] : bits) ASSERT_EQ(decoder.bit(p), bit);
    EXPECT_NO_THROW(decoder.finish());
  }
}

}  // namespace cleft
