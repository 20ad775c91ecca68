#include "base/output_folder.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "base/error.h"
#include "base/text.h"
#include "tests/support/temporary_folder.h"

namespace cleft {

namespace fs = std::filesystem;

namespace {

void fill(const OutputFolder& out, const std::string& text) {
  fs::create_directory(out.path() + "/out");
  std::ofstream(out.path() + "/out/a.txt") << text;
  std::ofstream(out.path() + "/out.txt") << text;
}

}  // namespace

TEST(OutputFolder, AppearsOnlyWithCommit) {
  const TemporaryFolder folder;
  {
    const OutputFolder out(folder.path(), "out");
    fill(out, "half");
    EXPECT_EQ(folder.entries(), 1);
  }
  EXPECT_EQ(folder.entries(), 0) << "something uncommitted was left behind";
}

TEST(OutputFolder, ReplacesWhatWasThere) {
  const TemporaryFolder folder;
  for (const char* text : {"old", "new"}) {
    OutputFolder out(folder.path(), "out");
    fill(out, text);
    if (text == std::string("old")) std::ofstream(out.path() + "/out/more.txt") << text;
    out.commit({"out", "out.txt"});
    EXPECT_EQ(folder.entries(), 3);
    EXPECT_EQ(read_text_file(folder / "out/a.txt"), text);
    EXPECT_EQ(read_text_file(folder / "out.txt"), text);
  }
  EXPECT_EQ(folder.entries(), 2);
  EXPECT_FALSE(fs::exists(folder / "out/more.txt"));
}

TEST(OutputFolder, AFailedCommitPutsTheOldOnesBack) {
  const TemporaryFolder folder;
  {
    OutputFolder out(folder.path(), "out");
    fill(out, "old");
    out.commit({"out", "out.txt"});
  }
  {
    OutputFolder out(folder.path(), "out");
    fill(out, "new");
    EXPECT_THROW(out.commit({"out", "out.txt", "absent"}), fs::filesystem_error);
  }
  EXPECT_EQ(folder.entries(), 2);
  EXPECT_EQ(read_text_file(folder / "out/a.txt"), "old");
  EXPECT_EQ(read_text_file(folder / "out.txt"), "old");
}

TEST(OutputFolder, BadPlacesAreInputErrors) {
  const TemporaryFolder folder;
  EXPECT_THROW(OutputFolder(folder / "absent", "out"), InputError);
  EXPECT_THROW(OutputFolder("/proc", "out"), InputError) << "root may write everywhere else";
}

}  // namespace cleft
