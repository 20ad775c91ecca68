// cleft export as a user runs it: what it writes where, and what it refuses.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "base/text.h"
#include "tests/io/wedge_row.h"
#include "tests/pipeline/commands.h"
#include "tests/snapshot/point_array.h"
#include "tests/support/temporary_folder.h"

namespace cleft {

namespace fs = std::filesystem;

namespace {

class Export : public testing::Test {
 protected:
  TemporaryFolder in, out;

  std::string snapshot(const std::string& name = "case.h5", std::size_t frames = 3) {
    std::vector<double> times;
    for (std::size_t j = 0; j < frames; ++j) times.push_back(static_cast<double>(j));
    write_snapshot(in / name, wedge_row(300, times));
    return in / name;
  }

  /// A folder as `cleft run` leaves it.
  std::string study() {
    in.write("study.toml", "[case]\n");
    for (const char* hash : {"0123abcd", "4567cdef"}) {
      fs::create_directories(in / "cases/" + hash);
      snapshot(std::string("cases/") + hash + "/case.h5", 2);
      in.write(std::string("cases/") + hash + "/manifest.json", "{}");
    }
    return in.path();
  }

  /// All files below a folder, hidden ones too.
  static std::set<std::string> files(const TemporaryFolder& folder) {
    std::set<std::string> names;
    for (const auto& entry : fs::recursive_directory_iterator(folder.path()))
      if (!entry.is_directory()) names.insert(fs::relative(entry.path(), folder.path()).string());
    return names;
  }

  void expect_refused(const std::vector<std::string>& arguments, const std::vector<std::string>& parts) {
    const auto before = files(out);
    const int entries = out.entries();
    const Outcome outcome = run_cleft("export", arguments);
    EXPECT_EQ(outcome.exit_code, 2) << outcome.output;
    for (const std::string& part : parts)
      EXPECT_NE(outcome.output.find(part), std::string::npos)
          << "missing '" << part << "' in: " << outcome.output;
    EXPECT_EQ(files(out), before);
    EXPECT_EQ(out.entries(), entries) << "something was left behind";
  }
};

const std::set<std::string> three_frames = {"out.pvd", "out/frame_0000.vtu", "out/frame_0001.vtu",
                                            "out/frame_0002.vtu"};

}  // namespace

TEST_F(Export, WritesTheSameUnderEveryNameOfThePlace) {
  const std::string file = snapshot();
  for (const char* name : {"out", "out.pvd", "out/", "./out.pvd"}) {
    const TemporaryFolder place;
    expect_success(run_cleft("export", {file, "--paraview", place / name}));
    EXPECT_EQ(files(place), three_frames) << name;
    EXPECT_EQ(place.entries(), 2);
  }
}

TEST_F(Export, TellsItsFigures) {
  const auto figures = nlohmann::json::parse(
      expect_success(run_cleft("export", {snapshot(), "--paraview", out / "out.pvd", "--json"})).output);
  std::uintmax_t bytes = 0;
  for (const std::string& file : files(out)) bytes += fs::file_size(out / file);
  EXPECT_EQ(figures["frames"], 3);
  EXPECT_EQ(figures["files"], 4);
  EXPECT_EQ(figures["bytes"], bytes);
}

TEST_F(Export, ReplacesAnEarlierExportWhole) {
  expect_success(run_cleft("export", {snapshot("long.h5", 5), "--paraview", out / "out.pvd"}));
  EXPECT_EQ(files(out).size(), 6u);
  expect_success(run_cleft("export", {snapshot(), "--paraview", out / "out.pvd"}));
  EXPECT_EQ(files(out), three_frames);
  EXPECT_EQ(out.entries(), 2);
}

TEST_F(Export, KeepsAnEarlierExportWhereItFails) {
  const std::string file = snapshot();
  expect_success(run_cleft("export", {file, "--paraview", out / "out.pvd"}));
  const std::string before = read_text_file(out / "out/frame_0001.vtu"), bytes = read_text_file(file);
  expect_refused({in.write("bad.h5", bytes.substr(0, bytes.size() / 2)), "--paraview", out / "out.pvd"},
                 {"bad.h5"});
  EXPECT_EQ(read_text_file(out / "out/frame_0001.vtu"), before);
}

TEST_F(Export, AStudyIsAPvdForEachPublishedCase) {
  const std::string folder = study();
  for (int time = 0; time < 2; ++time) {  // and again over itself
    const auto figures = nlohmann::json::parse(
        expect_success(run_cleft("export", {folder, "--paraview", out / "pictures", "--json"})).output);
    EXPECT_EQ(figures["cases"], 2);
    EXPECT_EQ(figures["frames"], 4);
    EXPECT_EQ(figures["files"], 6);
    EXPECT_EQ(files(out), (std::set<std::string>{"pictures/0123abcd.pvd", "pictures/0123abcd/frame_0000.vtu",
                                                 "pictures/0123abcd/frame_0001.vtu", "pictures/4567cdef.pvd",
                                                 "pictures/4567cdef/frame_0000.vtu",
                                                 "pictures/4567cdef/frame_0001.vtu"}));
    EXPECT_EQ(out.entries(), 1);
  }
}

TEST_F(Export, RefusesBadCasesOfAStudyAllAtOnce) {
  const std::string folder = study();
  expect_refused({folder, "--paraview", out / "x.pvd"}, {"is a study", "give a folder"});
  expect_refused({folder, "--paraview", folder}, {"is the input"});
  expect_refused({folder, "--paraview", folder + "/cases"}, {"exists"});
  fs::resize_file(folder + "/cases/0123abcd/case.h5", 1000);
  fs::remove(folder + "/cases/4567cdef/case.h5");
  expect_refused({folder, "--paraview", out / "x"}, {"0123abcd/case.h5", "4567cdef/case.h5"});
  fs::remove_all(folder + "/cases");
  expect_refused({folder, "--paraview", out / "x"}, {"no case is published"});
  fs::remove(folder + "/study.toml");
  expect_refused({folder, "--paraview", out / "x"}, {"is not a study folder"});
}

TEST_F(Export, RefusesWhatIsNoSoundSnapshot) {
  const std::string bytes = read_text_file(snapshot()), to = out / "x.pvd";
  expect_refused({in / "absent.h5", "--paraview", to}, {"absent.h5", "no such file"});
  expect_refused({in.write("a.toml", "[case]\n"), "--paraview", to}, {"a.toml"});
  h5::File::create(in / "other.h5").close();
  expect_refused({in / "other.h5", "--paraview", to}, {"other.h5", "is not a snapshot"});
  expect_refused({in.write("bad.h5", bytes.substr(0, bytes.size() * 2 / 3)), "--paraview", to}, {"bad.h5"});

  // A bit of the last frame: found after the others are written.
  const std::vector<double> last = displacements(wedge_row(300, {0}), 2);
  const std::size_t at = bytes.find(std::string(reinterpret_cast<const char*>(last.data()), 80));
  ASSERT_NE(at, std::string::npos);
  std::string flipped = bytes;
  flipped[at + 8] = static_cast<char>(flipped[at + 8] ^ 1);
  expect_refused({in.write("bad.h5", flipped), "--paraview", to}, {"bad.h5", "displacement", "damaged"});

  add_point_array(snapshot(), "odd", std::vector<double>(7), {7});
  expect_refused({in / "case.h5", "--paraview", to},
                 {"case.h5", "/VTKHDF/PointData/odd", "a row a point (1800)"});
}

TEST_F(Export, RefusesToReplaceWhatIsNotItsOwn) {
  const std::string file = snapshot();
  const auto refused = [&](const std::string& what) {
    expect_refused({file, "--paraview", out / "out.pvd"}, {what, "give another name"});
    for (const std::string& name : files(out)) EXPECT_EQ(read_text_file(out / name), "mine");
  };
  out.write("out.pvd", "mine");
  refused("out.pvd: exists and was not written by cleft export");
  fs::remove(out / "out.pvd");
  out.write("out", "mine");
  refused("out: exists and is not a folder");
  fs::remove(out / "out");
  fs::create_directory(out / "out");
  out.write("out/frame_0000.vtu", "mine");  // of another program, as far as one can tell
  refused("without out.pvd");
  out.write("out/notes.txt", "mine");
  refused("is not a folder of frames");
  fs::remove_all(out / "out");

  expect_success(run_cleft("export", {file, "--paraview", out / "out.pvd"}));
  fs::rename(out / "out", out / "elsewhere");
  fs::create_directory_symlink("elsewhere", out / "out");
  expect_refused({file, "--paraview", out / "out.pvd"}, {"is not a folder of frames"});
  fs::remove(out / "out");
  fs::rename(out / "elsewhere", out / "out");
  out.write("out/notes.txt", "mine");
  expect_refused({file, "--paraview", out / "out.pvd"}, {"is not a folder of frames"});
  expect_refused({study(), "--paraview", out.path()}, {"exists"});
}

TEST_F(Export, RefusesPlacesThatCannotBe) {
  const std::string file = snapshot(), kept = read_text_file(file);
  expect_refused({file, "--paraview", file}, {"is the input"});
  fs::copy_file(file, in / "same.pvd");
  expect_refused({in / "same.pvd", "--paraview", in / "same"}, {"was not written by cleft export"});
  EXPECT_EQ(read_text_file(file), kept);
  EXPECT_EQ(read_text_file(in / "same.pvd"), kept);
  expect_refused({file, "--paraview", out / "absent/x.pvd"}, {"absent", "does not exist"});
  expect_refused({file, "--paraview", "/proc/x.pvd"}, {"/proc", "cannot be written"});
  expect_refused({file, "--paraview", "/"}, {"give a name"});
  expect_refused({file, "--paraview", ""}, {"give a name"});
  expect_refused({file}, {"--paraview"});
  expect_refused({file, "--paraview", out / "x.pvd", "--cinema", out / "x.cdb"}, {"--cinema"});
}

/// What is no user's mistake ends with exit code 1, and leaves nothing either.
TEST_F(Export, AFullDiskIsTold) {
  const Outcome outcome = on_a_full_disk(
      8, std::string(CLEFT_BIN) + "/cleft export " + snapshot() + " --paraview " + (out / "x.pvd"));
  EXPECT_EQ(outcome.exit_code, 1) << outcome.output;
  EXPECT_NE(outcome.output.find("disk full"), std::string::npos) << outcome.output;
  EXPECT_EQ(out.entries(), 0);
}

}  // namespace cleft
