// A few of the faults that cleft-faults makes by the hundred.
#include <gtest/gtest.h>

#include "tests/faults/disk.h"
#include "tests/faults/flips.h"
#include "tests/faults/kills.h"
#include "tests/support/temporary_folder.h"

namespace cleft::faults {
namespace {

class Faults : public testing::Test {
 protected:
  const TemporaryFolder place_;
  const StudyUnderFault study_{place_.path(), 1};
  std::mt19937 random_{20};
};

TEST_F(Faults, KillsLoseNothing) {
  const KillReport report = kill_at_random(study_, 3, random_);
  EXPECT_EQ(report.kills, 3);
}

TEST_F(Faults, DamagedFilesAreRefusedOrRead) {
  const FlipReport report = flip_at_random(study_, 250, random_);
  EXPECT_EQ(report.detected + report.without_effect, 250);
  EXPECT_GT(report.detected, 125);
}

TEST_F(Faults, AFullDiskDelaysAStudy) {
  const auto report = fill_the_disk(study_, 1, random_);
  if (!report) GTEST_SKIP() << "only root may mount a small file system";
  EXPECT_EQ(report->runs, 1);
}

TEST(FaultsOnTwoRanks, AFullDiskDelaysAStudy) {
  const TemporaryFolder place;
  const StudyUnderFault study(place.path(), 2);
  std::mt19937 random(3);
  const auto report = fill_the_disk(study, 1, random);
  if (!report) GTEST_SKIP() << "only root may mount a small file system";
  EXPECT_EQ(report->runs, 1);
}

TEST(FaultsOnThreeRanks, KillsLoseNothing) {
  const TemporaryFolder place;
  const StudyUnderFault study(place.path(), 3);
  std::mt19937 random(5);
  EXPECT_EQ(kill_at_random(study, 2, random).kills, 2);
}

TEST(FaultsOnTwoRanks, AFailingWriteDelaysAStudy) {
  const TemporaryFolder place;
  const StudyUnderFault study(place.path(), 2);
  std::mt19937 random(6);
  EXPECT_EQ(fail_writes(study, 1, random).runs, 1);
}

TEST_F(Faults, AFailingWriteDelaysAStudy) { EXPECT_EQ(fail_writes(study_, 1, random_).runs, 1); }

}  // namespace
}  // namespace cleft::faults
