// Nodes spread over processes: the same fields as in one, byte for byte. The first rank runs the tests, and
// the others serve it.
#include "encoder/command/spread_nodes.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "base/error.h"
#include "base/ranks/other_ranks.h"
#include "encoder/at_nodes.h"
#include "encoder/encode.h"
#include "tests/encoder/bent_snapshot.h"
#include "tests/encoder/fine_snapshot.h"

namespace cleft {

namespace {

const Ranks* all_ranks = nullptr;

SeriesStorage in_blocks(std::size_t most, std::size_t block) {
  SeriesStorage storage;
  storage.most = most, storage.block = block;
  return storage;
}

SeriesStorage spread(SeriesStorage storage) {
  storage.spread = spread_over(*all_ranks);
  return storage;
}

void expect_same(const std::optional<CodedResidual>& a, const std::optional<CodedResidual>& b) {
  ASSERT_EQ(a.has_value(), b.has_value());
  if (!a) return;
  EXPECT_EQ(a->quantum, b->quantum);
  EXPECT_EQ(a->block, b->block);
  EXPECT_EQ(a->blocks, b->blocks);
}

void expect_same_fields(const Series& here, const Series& there) {
  EncodeOptions options;
  options.tolerance = 0.005;
  const Encoded a = encode(here, options, silent), b = encode(there, options, silent);
  EXPECT_EQ(a.field.coefficients(), b.field.coefficients());
  EXPECT_EQ(a.field.report.node_error, b.field.report.node_error);
  EXPECT_EQ(a.field.report.spline_error, b.field.report.spline_error);
  EXPECT_EQ(a.field.report.relative_l2, b.field.report.relative_l2);
  EXPECT_EQ(a.field.report.worst_node, b.field.report.worst_node);
  expect_same(a.residual, b.residual);
  ASSERT_EQ(a.of_quantities.size(), b.of_quantities.size());
  for (std::size_t q = 0; q < a.of_quantities.size(); ++q) {
    EXPECT_EQ(a.field.quantities[q].coefficients, b.field.quantities[q].coefficients);
    EXPECT_EQ(a.field.quantities[q].error, b.field.quantities[q].error);
    expect_same(a.of_quantities[q], b.of_quantities[q]);
  }
}

}  // namespace

TEST(SpreadNodes, FieldsAreThoseOfOneProcess) {
  const FineSnapshot fine;
  const SeriesStorage blocks = in_blocks(3000, 1700);
  const Series here(fine.reader(), blocks), there(fine.reader(), spread(blocks));
  ASSERT_FALSE(here.elsewhere);
  ASSERT_TRUE(there.elsewhere);
  expect_same_fields(here, there);
}

TEST(SpreadNodes, ThereMayBeFewerBlocksThanProcesses) {
  const FineSnapshot fine;
  const SeriesStorage blocks = in_blocks(3000, 1 << 18);
  expect_same_fields(Series(fine.reader(), blocks), Series(fine.reader(), spread(blocks)));
}

TEST(SpreadNodes, NodesOfABentSeriesAreReadInItsAxes) {
  const BentSnapshot bent([](const Vec3& p, Side side, double t) {
    const double open = std::max(0., t - 4 - p.x) * std::max(0., 1 + p.z / 1.5);
    return Vec3{0.01 * t * p.y, 0.1 * sign_of(p, side) * std::sqrt(open) * std::exp(-std::abs(p.y)),
                0.02 * t};
  });
  const SnapshotReader reader(bent.file);
  const SeriesStorage blocks = in_blocks(300, 64);
  expect_same_fields(Series(reader, blocks), Series(reader, spread(blocks)));
}

TEST(SpreadNodes, AFailureElsewhereIsToldWithItsProcess) {
  if (all_ranks->count() == 1) GTEST_SKIP() << "on several ranks";
  const FineSnapshot fine;
  SeriesStorage storage = in_blocks(3000, 1700);
  storage.spread = [&](auto values, auto nodes, auto times, std::size_t block) {
    std::filesystem::remove(fine.file());  // this process has opened it
    return spread_over(*all_ranks)(std::move(values), nodes, times, block);
  };
  try {
    const Series there(fine.reader(), storage);
    FAIL() << "nothing was told";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("process 1: " + fine.file()), std::string::npos) << error.what();
  }
  // The others still serve.
  const FineSnapshot another;
  const Series there(another.reader(), spread(in_blocks(3000, 1700)));
  EXPECT_EQ(there.elsewhere->errors({NodeSpline::displacement, 3, {encode(there, {}, silent).field}}).size(),
            there.times.size() * ((there.node_samples().size() - 1) / 1700 + 1));
}

}  // namespace cleft

int main(int argc, char** argv) {
  const cleft::Ranks ranks(argc, argv);
  cleft::all_ranks = &ranks;
  if (ranks.rank() > 0) {
    cleft::serve_nodes(ranks);
    return 0;
  }
  const cleft::OtherRanks others(ranks);
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
