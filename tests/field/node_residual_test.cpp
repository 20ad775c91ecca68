#include "encoder/field/node_residual.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include "base/error.h"

namespace cleft {

namespace {

std::vector<std::uint8_t> coded(const NodeResidual& residual, std::span<const std::int32_t> order = {}) {
  const auto bytes = encode_residual(residual, order);
  EXPECT_EQ(decode_residual(residual.nodes, residual.frames, bytes, order), residual.values);
  return bytes;
}

/// Small values that change slowly from node to node and frame to frame.
NodeResidual smooth(int nodes, int frames) {
  NodeResidual residual{0.01, nodes, frames, {}};
  for (int n = 0; n < nodes; ++n)
    for (int c = 0; c < 3; ++c)
      for (int f = 0; f < frames; ++f)
        residual.values.push_back(
            static_cast<std::int32_t>(std::lround(1.4 * std::sin(0.05 * n + c) * std::cos(0.2 * f))));
  return residual;
}

}  // namespace

TEST(NodeResidual, GivesBackWhatItWasGiven) {
  std::mt19937 random(2);
  for (const auto [nodes, frames] : {std::array{0, 5}, {5, 0}, {1, 1}, {40, 3}, {7, 60}})
    for (const std::int64_t largest :
         {std::int64_t{0}, std::int64_t{1}, std::int64_t{30}, std::int64_t{2147483647}}) {
      NodeResidual residual{1, nodes, frames,
                            std::vector<std::int32_t>(static_cast<std::size_t>(3) * nodes * frames)};
      for (auto& value : residual.values)
        value = static_cast<std::int32_t>(static_cast<std::int64_t>(random() % (2 * largest + 1)) - largest);
      coded(residual);
    }
}

TEST(NodeResidual, NothingCostsNothing) {
  EXPECT_LE(coded({1, 10000, 40, std::vector<std::int32_t>(3 * 10000 * 40, 0)}).size(), 30u);
}

TEST(NodeResidual, GivesTheSameBytesOnEveryMachine) {
  NodeResidual residual{1, 90, 12, {}};
  std::uint64_t state = 3;
  for (int n = 0; n < 3 * 90 * 12; ++n) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    residual.values.push_back(static_cast<std::int32_t>(state >> 62) * (n / 40 % 3 - 1));
  }
  std::uint64_t hash = 14695981039346656037u;
  for (const std::uint8_t byte : coded(residual)) hash = (hash ^ byte) * 1099511628211u;
  EXPECT_EQ(hash, 18310167330991416910u);
}

TEST(NodeResidual, NeighboursSaveBytes) {
  const NodeResidual residual = smooth(2000, 20);
  std::vector<std::int32_t> shuffled(2000);
  std::iota(shuffled.begin(), shuffled.end(), 0);
  std::shuffle(shuffled.begin(), shuffled.end(), std::mt19937(1));
  EXPECT_LT(2 * coded(residual).size(), coded(residual, shuffled).size());
  EXPECT_LT(8. * static_cast<double>(coded(residual).size()) / static_cast<double>(residual.values.size()),
            0.15);
}

TEST(NodeResidual, DamagedBytesNeverDoMoreThanThrowOrGiveOtherValues) {
  const NodeResidual residual = smooth(300, 10);
  const auto bytes = coded(residual);
  std::mt19937 random(3);
  int thrown = 0;
  for (int n = 0; n < 400; ++n) {
    auto damaged = bytes;
    damaged[random() % damaged.size()] ^= static_cast<std::uint8_t>(1 << random() % 8);
    if (n % 2)
      for (auto& byte : damaged) byte = static_cast<std::uint8_t>(random());
    try {
      decode_residual(300, 10, damaged);
    } catch (const InputError&) {
      ++thrown;
    }
  }
  EXPECT_GT(thrown, 100);
  for (std::size_t size = 0; size + 8 < bytes.size(); size += 11)
    EXPECT_THROW(decode_residual(300, 10, {bytes.data(), size}), InputError) << size;
  auto longer = bytes;
  longer.insert(longer.end(), 9, 1);
  EXPECT_THROW(decode_residual(300, 10, longer), InputError);
}

TEST(NodeResidual, TheOneNumberThatHasNoNegativeIsRefused) {
  NodeResidual residual{1, 2, 2, std::vector<std::int32_t>(12, 0)};
  residual.values[7] = std::numeric_limits<std::int32_t>::min();
  EXPECT_THROW(encode_residual(residual), InputError);
}

}  // namespace cleft
