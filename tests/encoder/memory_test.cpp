// Frames in a temporary file, and what an encoding says that it needs.
#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <random>

#include "base/error.h"
#include "encoder/memory_need.h"
#include "tests/encoder/synthetic_snapshot.h"
#include "tests/support/temporary_folder.h"

namespace cleft {

namespace {

Eigen::MatrixX3d random_frame(Eigen::Index rows, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  return Eigen::MatrixX3d::NullaryExpr(rows, 3, [&] { return normal(random); });
}

/// Of 10^6 nodes and 40 frames.
MemoryNeed a_million() {
  MemoryNeed need;
  need.nodes = 1e6, need.frames = 40, need.components = 3;
  need.values = 960e6, need.others = 880e6;
  return need;
}

}  // namespace

TEST(StoredFrames, AFileGivesBackWhatMemoryGives) {
  const TemporaryFolder folder;
  for (const Eigen::Index rows : {1, 500, 100000}) {
    const auto file = std::make_shared<SpillFile>(folder / "");
    StoredFrames<3> in_file(file), in_memory;
    for (unsigned j = 0; j < 5; ++j)
      in_file.push_back(random_frame(rows, j)), in_memory.push_back(random_frame(rows, j));
    EXPECT_EQ(folder.entries(), 0) << "the file has a name";
    for (std::size_t j = 0; j < 5; ++j) {
      in_file.forget(j), in_memory.forget(j);
      EXPECT_EQ(in_file[j], in_memory[j]);
    }
    StoredFrames<3> copy = in_file, own = in_file.like_these();
    EXPECT_EQ(copy[3].data(), in_file[3].data()) << "copies share what never changes";
    EXPECT_TRUE(own.empty());
    own.push_back(in_file[2]);
    in_file = in_memory;
    EXPECT_EQ(copy[4], in_memory[4]) << "a copy keeps the file";
    EXPECT_EQ(own.back(), in_memory[2]);
    copy.assign(3, in_memory[1]);
    EXPECT_EQ(copy.size(), 3u);
    EXPECT_EQ(copy.front().data(), copy.back().data());
  }
  EXPECT_THROW(SpillFile(folder / "absent"), InputError);
}

/// The same field, bit by bit, with what it leaves at the nodes and a further quantity.
TEST(StoredFrames, AnEncodingFromAFileIsTheSame) {
  std::vector<double> times;
  for (int j = 0; j <= 12; ++j) times.push_back(0.5 * j);
  const SyntheticSnapshot snapshot(cut_in(grid(), times), [](const Vec3& p, Side side, double t) {
    const double open = std::max(0., t - 2 - p.x);
    return Vec3{0.01 * t * std::sin(3 * p.y),
                0.2 * sign_of(p, side) * std::sqrt(open) * std::exp(-std::abs(p.y)), 0};
  });
  const TemporaryFolder folder;
  const Series in_memory = snapshot.series(),
               in_file = Series(snapshot.reader(), {std::make_shared<SpillFile>(folder / "")});
  EncodeOptions options;
  options.tolerance = 1e-3;
  const Encoded a = encode(in_memory, options, [](const std::string&) {}),
                b = encode(in_file, options, [](const std::string&) {});
  EXPECT_EQ(a.field.coefficients(), b.field.coefficients());
  ASSERT_EQ(a.residual.has_value(), b.residual.has_value());
  if (!a.residual) return;
  EXPECT_EQ(a.residual->blocks, b.residual->blocks);
}

TEST(MemoryNeed, ValuesGoToAFileOnlyWhereTheyMust) {
  const TemporaryFolder folder;
  MemoryNeed need = a_million();
  const double all = need.in_memory();
  EXPECT_GE(all, 960e6 + 880e6);
  need.fit_into(all, folder / "", "case.h5");
  EXPECT_FALSE(need.spilled);
  need.fit_into(all - 1, folder / "", "case.h5");
  EXPECT_TRUE(need.spilled);
  EXPECT_EQ(need.in_memory(), all - 960e6);
}

TEST(MemoryNeed, WhatDoesNotFitIsRefusedWithTheRemedy) {
  const TemporaryFolder folder;
  const auto refused = [&](MemoryNeed need, double memory, const std::vector<std::string>& parts) {
    try {
      need.fit_into(memory, folder / "", "case.h5");
      ADD_FAILURE() << "accepted";
    } catch (const InputError& e) {
      for (const std::string& part : parts)
        EXPECT_NE(std::strstr(e.what(), part.c_str()), nullptr) << part << " in: " << e.what();
    }
  };
  refused(a_million(), 0.5e9,
          {"case.h5: 1000000 nodes and 40 frames of 3 numbers", "0.5 GB may be used", "--memory"});
  MemoryNeed huge = a_million();
  huge.values = 1e18;  // no disk has so much
  refused(huge, 2e9, {"temporary file", "TMPDIR", "--memory"});
}

}  // namespace cleft
