// cleft import and cleft decode under mpirun: the files of one process, byte for byte, written once.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
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

/// The side of a node tells its cell, too.
CrackedBody without_shared_nodes() {
  CrackedBody body = edge_crack();
  body.a = planes(0, 40, 20), body.b = planes(-15, 15, 10), body.c = {-6, 0};
  body.side = [](const Vec3&, const Vec3& middle) {
    const auto cell = static_cast<int>(middle.x + 41 * (middle.y + 16));
    return middle.y < 0 ? -cell : cell;
  };
  body.displacement = [crack = body.displacement](const Vec3& abc, int side, double t) {
    return crack(abc, side < 0 ? -1 : 1, t);
  };
  return body;
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
  /// By several processes as by one, which notes something.
  void expect_import_of(const std::string& series, const std::string& note) {
    std::vector<std::string> arguments = {series, "--field", "displacement", "--out", alone_ + "/case.h5"};
    const std::string alone = expect_success(run_cleft("import", arguments)).output;
    EXPECT_NE(alone.find(note), std::string::npos) << alone;
    arguments.back() = several_ + "/case.h5";
    for (const int ranks : {1, 2, 3}) {
      const std::string output = expect_success(cleft_on_ranks("import", ranks, arguments)).output;
      EXPECT_TRUE(output.ends_with(alone))
          << output;  // what MPI says of a machine it does not know is before
      EXPECT_TRUE(files_in(alone_) == files_in(several_)) << series << " on " << ranks;
      fs::remove(arguments.back());
    }
    fs::rename(alone_ + "/case.h5", folder_ / "snapshot.h5");
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

TEST_F(SeriesOnRanks, ImportedSnapshotIsThatOfOneProcess) {
  // Frame 1, which the second process reads, tells alone that nodes move.
  CrackedBody moved = edge_crack();
  moved.times = {1};
  moved.place = [](const Vec3& abc) { return abc + Vec3{0, 0, 0.5 * abc.z}; };
  folder_.write("series_1.vtu", moved.series().vtu(0));
  expect_import_of(series_, "between frames");
  expect_import_of(without_shared_nodes().series().write(folder_, "loose"), "were welded");
  fs::rename(folder_ / "snapshot.h5", folder_ / "source.h5");
  expect_import_of(folder_ / "source.h5", "");

  CrackedBody finer = edge_crack();
  finer.a.insert(finer.a.begin() + 1, 0.5), finer.times = {12};
  folder_.write("series_12.vtu", finer.series().vtu(0));
  expect_import_of(series_, "have another mesh");
}

TEST_F(SeriesOnRanks, WhatIsWrongWithAFrameEndsAllProcesses) {
  const std::string whole = read_text_file(folder_ / "series_4.vtu");
  std::string infinite = whole, unnamed = whole;
  unnamed.replace(unnamed.find("displacement"), 12, "velocity____");
  infinite.replace(infinite.find("0.", infinite.find("displacement")), 2, "inf ");
  for (const std::string& damaged : {whole.substr(0, whole.size() / 2), unnamed, infinite}) {
    folder_.write("series_4.vtu", damaged);
    const Outcome alone = run_cleft("import", import_arguments(alone_));
    EXPECT_EQ(alone.exit_code, 2);
    EXPECT_NE(alone.output.find("series_4.vtu"), std::string::npos) << alone.output;
    for (const int ranks : {2, 3}) {  // the fifth frame is read by the first process and by the second one
      const Outcome several = cleft_on_ranks("import", ranks, import_arguments(several_));
      EXPECT_EQ(several.exit_code, 2);
      EXPECT_EQ(count_of(several.output, alone.output), 1) << several.output << alone.output;
      EXPECT_EQ(count_of(several.output, "error:"), 1) << several.output;
      EXPECT_TRUE(fs::is_empty(several_));
    }
  }
}

TEST_F(SeriesOnRanks, WhatOneProcessCannotReadIsToldOfIt) {
  // The second process, whose folder is another one, finds its frame damaged there.
  const std::string elsewhere = folder_ / "elsewhere";
  fs::create_directory(elsewhere);
  const std::string frame = "/proc/self/cwd/series_4.vtu";
  std::string list = read_text_file(series_);
  folder_.write("own.pvd", list.replace(list.find("series_4.vtu"), 12, frame));
  std::ofstream(elsewhere + "/series_4.vtu") << "<VTKFile>";
  const Outcome outcome = in_shell(
      "cd " + folder_.path() + "; timeout 60 mpirun --oversubscribe --bind-to none -n 3 bash -c \"" +
      "[ \\$OMPI_COMM_WORLD_RANK != 1 ] || cd " + elsewhere + "; exec " CLEFT_BIN + "/cleft-import " +
      (folder_ / "own.pvd") + " --field displacement --out " + several_ + "/case.h5\"");
  EXPECT_EQ(outcome.exit_code, 2) << outcome.output;
  EXPECT_EQ(count_of(outcome.output, "cleft import: error: process 1: " + frame), 1) << outcome.output;
  EXPECT_TRUE(fs::is_empty(several_));
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
