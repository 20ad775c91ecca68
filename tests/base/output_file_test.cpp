#include "base/output_file.h"

#include <gtest/gtest.h>

#include <fstream>

#include "base/error.h"
#include "base/text.h"
#include "tests/support/temporary_folder.h"

namespace cleft {

TEST(OutputFile, AppearsOnlyWithCommit) {
  const TemporaryFolder folder;
  {
    OutputFile out(folder / "a.txt");
    std::ofstream(out.path()) << "half";
    EXPECT_EQ(folder.entries(), 1);
  }
  EXPECT_EQ(folder.entries(), 0) << "an uncommitted file was left behind";
  write_text_file(folder / "a.txt", "whole");
  EXPECT_EQ(read_text_file(folder / "a.txt"), "whole");
}

TEST(OutputFile, AnOlderFileSurvivesAFailure) {
  const TemporaryFolder folder;
  folder.write("a.txt", "old");
  { std::ofstream(OutputFile(folder / "a.txt").path()) << "new"; }
  EXPECT_EQ(read_text_file(folder / "a.txt"), "old");
}

TEST(OutputFile, NeitherInputsNorDevicesAreOverwritten) {
  const TemporaryFolder folder;
  const std::string input = folder.write("a.txt", "input");
  EXPECT_THROW(refuse_to_overwrite(folder.path() + "/./a.txt", {"", input}), InputError);
  EXPECT_NO_THROW(refuse_to_overwrite(folder / "b.txt", {input}));
  EXPECT_THROW(OutputFile("/dev/null"), InputError);
}

TEST(OutputFile, BadPlacesAreInputErrors) {
  const TemporaryFolder folder;
  EXPECT_THROW(OutputFile(folder / "absent/a.txt"), InputError);
  EXPECT_THROW(OutputFile(folder.path()), InputError);
}

}  // namespace cleft
