// cleft encode under mpirun.
#include <gtest/gtest.h>

#include "base/text.h"
#include "tests/encoder/synthetic_snapshot.h"
#include "tests/pipeline/commands.h"

namespace cleft {

TEST(EncodeCommand, OneOfSeveralProcessesEncodesASmallSnapshot) {
  const TemporaryFolder folder;
  const SyntheticSnapshot snapshot(opening);
  const std::string alone = folder / "alone.dffd", several = folder / "several.dffd";
  expect_success(run_cleft("encode", {snapshot.reader().values().file().path(), "--out", alone}));
  const Outcome outcome = expect_success(
      cleft_on_ranks("encode", 3, {snapshot.reader().values().file().path(), "--out", several}));
  EXPECT_NE(outcome.output.find("one of the 3 processes encodes this snapshot"), std::string::npos)
      << outcome.output;
  EXPECT_EQ(read_text_file(alone), read_text_file(several));
}

TEST(EncodeCommand, AMistakeEndsAllProcesses) {
  const TemporaryFolder folder;
  const Outcome outcome = cleft_on_ranks("encode", 3, {folder / "none.h5", "--out", folder / "none.dffd"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.output.find("none.h5: no such file"), std::string::npos) << outcome.output;
}

TEST(EncodeCommand, ProcessesThatDoNotKnowEachOtherAreRefused) {
  const TemporaryFolder folder;
  const Outcome outcome =
      in_shell("SLURM_STEP_NUM_TASKS=2 " CLEFT_BIN "/cleft-encode a.h5 --out " + (folder / "a.dffd"));
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.output.find("each of them finds itself alone"), std::string::npos) << outcome.output;
}

}  // namespace cleft
