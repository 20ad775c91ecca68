// cleft import and cleft decode under mpirun: the files of one process, byte for byte, written once.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>

#include "base/text.h"
#include "tests/import/cracked_bodies.h"
#include "tests/pipeline/commands.h"

namespace cleft {

namespace {

namespace fs = std::filesystem;

using Files = std::map<std::string, std::string>;  // contents by name

Files files_in(const std::string& folder) {
  Files files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file())
      files[fs::relative(entry.path(), folder).string()] = read_text_file(entry.path().string());
  return files;
}

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

class SeriesOnRanks : public ::testing::Test {
 protected:
  SeriesOnRanks() {
    fs::create_directory(alone_), fs::create_directory(several_);
    series_ = edge_crack().series().write(folder_);
  }
  std::vector<std::string> import_arguments(const std::string& out) const {
    return {series_, "--field", "displacement", "--out", out + "/case.h5"};
  }
  /// The field of the series.
  std::string field() const {
    const std::string snapshot = folder_ / "case.h5", file = folder_ / "case.dffd";
    expect_success(run_cleft("import", {series_, "--field", "displacement", "--out", snapshot}));
    expect_success(run_cleft("encode", {snapshot, "--tolerance", "0.05", "--out", file}));
    return file;
  }

  TemporaryFolder folder_;
  std::string series_, alone_ = folder_ / "alone", several_ = folder_ / "several";
};

}  // namespace

TEST_F(SeriesOnRanks, DecodedFilesAreThoseOfOneProcess) {
  const std::string file = field();
  for (const std::vector<std::string>& at :
       {std::vector<std::string>{"--nodes", folder_ / "case.h5", "--out", "/nodes.pvd"},
        {"--on", folder_ / "series_0.vtu", "--out", "/on"},
        {"--nodes", folder_ / "case.h5", "--out", "/nodes.vtkhdf"}}) {
    std::vector<std::string> here = {file, at[0], at[1], at[2], alone_ + at[3]}, there = here;
    there.back() = several_ + at[3];
    expect_success(run_cleft("decode", here));
    const std::string said = expect_success(cleft_on_ranks("decode", 3, there)).output;
    EXPECT_EQ(count_of(said, "one of the 3 processes writes"), at[3] == "/nodes.vtkhdf" ? 1 : 0) << said;
  }
  const Files alone = files_in(alone_);
  EXPECT_GT(alone.size(), 10) << "frames enough for all processes, twice";
  EXPECT_TRUE(alone == files_in(several_));
}

TEST_F(SeriesOnRanks, WhatFailsInOneProcessLeavesNothing) {
  const std::string file = field();
  // In the second process no file may grow beyond 4 kB, as on a full disk; messages go through sockets, since
  // memory that processes share is a file too.
  const Outcome outcome = in_shell(
      "OMPI_MCA_btl=self,tcp timeout 60 mpirun --oversubscribe --bind-to none -n 3 bash -c \"trap '' XFSZ; "
      "[ \\$OMPI_COMM_WORLD_RANK != 1 ] || ulimit -f 4; exec " CLEFT_BIN "/cleft-decode " +
      file + " --nodes " + (folder_ / "case.h5") + " --out " + several_ + "/out.pvd\"");
  EXPECT_EQ(outcome.exit_code, 1) << outcome.output;
  EXPECT_EQ(count_of(outcome.output, "cleft decode: failed: process 1: "), 1) << outcome.output;
  EXPECT_TRUE(fs::is_empty(several_));
}

TEST_F(SeriesOnRanks, AMistakeIsToldOnce) {
  for (const std::string command : {"decode", "import"}) {
    std::vector<std::string> arguments = {folder_ / "none.pvd", "--out", several_ + "/out.pvd"};
    arguments.push_back(command == "decode" ? "--on" : "--field");
    arguments.push_back(command == "decode" ? folder_ / "series_0.vtu" : "displacement");
    const Outcome outcome = cleft_on_ranks(command, 3, arguments);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(count_of(outcome.output, "error:"), 1) << outcome.output;
    EXPECT_TRUE(fs::is_empty(several_));
  }
}

TEST_F(SeriesOnRanks, OneOfSeveralProcessesImports) {
  expect_success(run_cleft("import", import_arguments(alone_)));
  const std::string said = expect_success(cleft_on_ranks("import", 3, import_arguments(several_))).output;
  EXPECT_EQ(count_of(said, "one of the 3 processes imports the series"), 1) << said;
  EXPECT_EQ(count_of(said, "nodes:"), 1) << said;
  EXPECT_TRUE(files_in(alone_) == files_in(several_));
}

TEST_F(SeriesOnRanks, ProcessesThatDoNotKnowEachOtherAreRefused) {
  for (const std::string command : {"decode a.dffd --on a.vtu", "import a.pvd --field u"}) {
    const Outcome outcome =
        in_shell("SLURM_STEP_NUM_TASKS=2 " CLEFT_BIN "/cleft-" + command + " --out " + several_ + "/out.pvd");
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_NE(outcome.output.find("each of them finds itself alone"), std::string::npos) << outcome.output;
  }
}

}  // namespace cleft
