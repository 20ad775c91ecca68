#include "encoder/field/node_residual.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include "base/error.h"

namespace cleft {

namespace {

/// The bytes of its only block.
std::vector<std::uint8_t> bytes_of(const NodeResidual& residual) {
  CodedResidual code = coded(residual);
  EXPECT_EQ(code.blocks.size(), 1u);
  EXPECT_EQ(decoded(code).values, residual.values);
  return code.blocks.front();
}

using Numbers = std::vector<std::int32_t>;

/// Small values that change slowly from node to node and frame to frame; nodes in an order.
NodeResidual smooth(const std::vector<int>& nodes, int frames) {
  Numbers values;
  for (const int n : nodes)
    for (int c = 0; c < 3; ++c)
      for (int f = 0; f < frames; ++f)
        values.push_back(
            static_cast<std::int32_t>(std::lround(1.4 * std::sin(0.05 * n + c) * std::cos(0.2 * f))));
  return {0.01, static_cast<int>(nodes.size()), frames, values};
}

std::vector<int> in_order(int nodes) {
  std::vector<int> order(static_cast<std::size_t>(nodes));
  std::iota(order.begin(), order.end(), 0);
  return order;
}

}  // namespace

TEST(NodeResidual, GivesBackWhatItWasGiven) {
  std::mt19937 random(2);
  for (const auto [nodes, frames] : {std::array{0, 5}, {5, 0}, {1, 1}, {40, 3}, {7, 60}})
    for (const std::int64_t largest :
         {std::int64_t{0}, std::int64_t{1}, std::int64_t{30}, std::int64_t{2147483647}}) {
      Numbers values(static_cast<std::size_t>(3) * nodes * frames);
      for (auto& value : values)
        value = static_cast<std::int32_t>(static_cast<std::int64_t>(random() % (2 * largest + 1)) - largest);
      const NodeResidual residual{1, nodes, frames, values};
      for (std::size_t i = 0; i < values.size(); ++i) ASSERT_EQ(residual.values[i], values[i]);
      bytes_of(residual);
    }
}

TEST(NodeResidual, ComesBackInBlocksOfAnySize) {
  const NodeResidual residual = smooth(in_order(100), 7);
  for (const int block : {1, 7, 50, 99, 100, 101}) {
    const CodedResidual code = coded(residual, block);
    EXPECT_EQ(code.blocks.size(), static_cast<std::size_t>((99 / block) + 1));
    EXPECT_EQ(decoded(code).values, residual.values) << block;
  }
}

/// Numbers that need four bytes do not change those before and after them.
TEST(SmallIntegers, HoldWhatFitsIntoAByteAndWhatDoesNot) {
  const Numbers some = {0, -128, 127, 3, -129, 128, std::numeric_limits<std::int32_t>::min(), 7};
  const SmallIntegers kept(some);
  for (std::size_t i = 0; i < some.size(); ++i) EXPECT_EQ(kept[i], some[i]);
  const SmallIntegers joined = SmallIntegers::joined({SmallIntegers(Numbers{1, 2}), kept, SmallIntegers()});
  ASSERT_EQ(joined.size(), some.size() + 2);
  EXPECT_EQ(joined[1], 2);
  for (std::size_t i = 0; i < some.size(); ++i) EXPECT_EQ(joined[i + 2], some[i]);
}

TEST(NodeResidual, NothingCostsNothing) {
  EXPECT_LE(bytes_of({1, 10000, 40, SmallIntegers(3 * 10000 * 40)}).size(), 30u);
}

TEST(NodeResidual, GivesTheSameBytesOnEveryMachine) {
  Numbers values;
  std::uint64_t state = 3;
  for (int n = 0; n < 3 * 90 * 12; ++n) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    values.push_back(static_cast<std::int32_t>(state >> 62) * (n / 40 % 3 - 1));
  }
  std::uint64_t hash = 14695981039346656037u;
  for (const std::uint8_t byte : bytes_of({1, 90, 12, values})) hash = (hash ^ byte) * 1099511628211u;
  EXPECT_EQ(hash, 18310167330991416910u);
}

TEST(NodeResidual, NeighboursSaveBytes) {
  const NodeResidual residual = smooth(in_order(2000), 20);
  std::vector<int> shuffled = in_order(2000);
  std::shuffle(shuffled.begin(), shuffled.end(), std::mt19937(1));
  const double bytes = static_cast<double>(bytes_of(residual).size());
  EXPECT_LT(2 * bytes, static_cast<double>(bytes_of(smooth(shuffled, 20)).size()));
  EXPECT_LT(8. * bytes / static_cast<double>(residual.values.size()), 0.15);
}

TEST(NodeResidual, DamagedBytesNeverDoMoreThanThrowOrGiveOtherValues) {
  const auto bytes = bytes_of(smooth(in_order(300), 10));
  const auto decode = [](std::span<const std::uint8_t> some) { decode_block(some, 300, 3, 10); };
  std::mt19937 random(3);
  int thrown = 0;
  for (int n = 0; n < 400; ++n) {
    auto damaged = bytes;
    damaged[random() % damaged.size()] ^= static_cast<std::uint8_t>(1 << random() % 8);
    if (n % 2)
      for (auto& byte : damaged) byte = static_cast<std::uint8_t>(random());
    try {
      decode(damaged);
    } catch (const InputError&) {
      ++thrown;
    }
  }
  EXPECT_GT(thrown, 100);
  for (std::size_t size = 0; size + 8 < bytes.size(); size += 11)
    EXPECT_THROW(decode({bytes.data(), size}), InputError) << size;
  auto longer = bytes;
  longer.insert(longer.end(), 9, 1);
  EXPECT_THROW(decode(longer), InputError);
}

TEST(NodeResidual, TheOneNumberThatHasNoNegativeIsRefused) {
  Numbers values(12, 0);
  values[7] = std::numeric_limits<std::int32_t>::min();
  EXPECT_THROW(encode_block(values, 3, 2), InputError);
}

}  // namespace cleft
