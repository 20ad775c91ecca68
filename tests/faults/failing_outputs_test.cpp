// Every command that writes a file, and a failure of each kind at its writes: the file appears whole or not
// at all, an older one of its name stays, nothing else is left, and the command says what has failed.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <map>
#include <memory>

#include "base/process.h"
#include "base/text.h"
#include "tests/support/small_study.h"
#include "tests/support/temporary_folder.h"

namespace cleft {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

struct Writer {
  std::string name;
  Words command;  ///< "IN/" and "OUT/" at the start of a word are the folders of inputs and of outputs
  /// Without one the outputs are a folder, or several files, that may not exist before.
  std::string output = {};
  friend void PrintTo(const Writer& writer, std::ostream* out) { *out << writer.name; }
};

const Writer writers[] = {
    {"solve", {"solve", "IN/case.toml", "--no-estimate", "--out", "OUT/case.h5"}, "case.h5"},
    {"encode", {"encode", "IN/case.h5", "--tolerance", "0.1", "--out", "OUT/case.dffd"}, "case.dffd"},
    {"eval",
     {"eval", "IN/case.dffd", "--nodes", "IN/case.h5", "--frame", "2", "--out", "OUT/n.csv"},
     "n.csv"},
    {"import", {"import", "IN/case.pvd", "--field", "displacement", "--out", "OUT/i.h5"}, "i.h5"},
    {"decode", {"decode", "IN/imported.dffd", "--nodes", "IN/imported.h5", "--out", "OUT/d.pvd"}},
    {"paraview", {"export", "IN/case.h5", "--paraview", "OUT/case.pvd"}},
    {"page", {"export", "IN/case.dffd", "--web", "OUT/case.html"}, "case.html"},
    {"vtp",
     {"cut", "--mesh", "IN/sheet.stl", "--path", "IN/path.csv", "--depth", "4", "--rest", "--out",
      "OUT/x.vtp"},
     "x.vtp"},
    {"obj",
     {"cut", "--mesh", "IN/sheet.stl", "--path", "IN/path.csv", "--depth", "4", "--rest", "--out",
      "OUT/x.obj"},
     "x.obj"},
    {"stl",
     {"cut", "--mesh", "IN/sheet.stl", "--path", "IN/path.csv", "--depth", "4", "--rest", "--out",
      "OUT/x.stl"},
     "x.stl"},
    {"haptic",
     {"haptic", "--mesh", "IN/sheet.stl", "--path", "IN/path.csv", "--depth", "4", "--seconds", "0.05",
      "--record", "OUT/r.csv"},
     "r.csv"},
    {"picture", {"explore", "IN/case.dffd", "--size", "64,48", "--screenshot", "OUT/x.png"}, "x.png"},
    {"movie", {"explore", "IN/case.dffd", "--script", "IN/movie.txt"}, "x.ogv"},
    {"session", {"explore", "IN/case.dffd", "--script", "IN/save.txt"}, "x.json"},
    {"interpolate",
     {"interpolate", "IN/study", "--set", "tissue.young_modulus=0.02,skin.prestress_v=0.03", "--out",
      "OUT/n.dffd"},
     "n.dffd"},
};

/// A word of a command with the folder that its first letters name; the folder's own name may hold any
/// letters.
std::string in_folder(const std::string& word, const std::string& inputs, const std::string& outputs) {
  if (word.starts_with("OUT/")) return outputs + word.substr(3);
  if (word.starts_with("IN/")) return inputs + word.substr(2);
  return word;
}

/// All files of a folder, hidden ones too, by their names in it.
std::map<std::string, std::string> files_in(const std::string& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    files[fs::relative(entry.path(), folder).string()] =
        entry.is_directory() ? "folder" : read_text_file(entry.path().string());
  return files;
}

class FailingOutput : public testing::TestWithParam<Writer> {
 protected:
  static void SetUpTestSuite() {
    in_ = std::make_unique<TemporaryFolder>();
    const TemporaryFolder& in = *in_;
    in.write("study.toml", small_study);
    in.write("path.csv", "x,y,z,nx,ny,nz\n-10,0.3,0,0,0,1\n10,0.1,0,0,0,1\n");
    in.write("sheet.stl", sheet());
    make({"run", in / "study.toml", "--out", in / "study", "--jobs", "2"});
    const fs::path first = fs::directory_iterator(in / "study/cases")->path();
    for (const char* name : {"case.toml", "case.h5", "case.dffd"})
      fs::copy_file(first / name, in / name, fs::copy_options::overwrite_existing);
    make({"export", in / "case.h5", "--paraview", in / "case.pvd"});
    make({"import", in / "case.pvd", "--field", "displacement", "--out", in / "imported.h5"});
    make({"encode", in / "imported.h5", "--tolerance", "0.1", "--out", in / "imported.dffd"});
  }
  static void TearDownTestSuite() { in_.reset(); }

  /// A flat sheet of 40 x 24 mm as text (.stl).
  static std::string sheet() {
    std::string text = "solid sheet\n";
    const auto triangle = [&](const std::array<std::array<int, 2>, 3>& corners) {
      text += "facet normal 0 0 1\nouter loop\n";
      for (const auto& [x, y] : corners)
        text += "vertex " + std::to_string(x) + " " + std::to_string(y) + " 0\n";
      text += "endloop\nendfacet\n";
    };
    for (int x = -20; x < 20; x += 2)
      for (int y = -12; y < 12; y += 2) {
        triangle({{{x, y}, {x + 2, y}, {x + 2, y + 2}}});
        triangle({{{x, y}, {x + 2, y + 2}, {x, y + 2}}});
      }
    return text + "endsolid sheet\n";
  }
  static void make(const Words& words) {
    Words argv{CLEFT_BIN "/cleft"};
    argv.insert(argv.end(), words.begin(), words.end());
    const ProcessResult result = run_process(argv, *in_ / "log", {});
    ASSERT_TRUE(result.success()) << words[0] << ": " << read_text_file(*in_ / "log");
  }

  /// Runs the command in a new folder of outputs, with an older output where it writes one file.
  struct Run {
    TemporaryFolder out, place;
    ProcessResult result;
    std::string said;
  };
  void run(Run& run, const std::map<std::string, std::string>& failure) const {
    const Writer& writer = GetParam();
    if (!writer.output.empty()) run.out.write(writer.output, "old");
    run.place.write("movie.txt", "movie " + run.out.path() + "/x.ogv 64 48 2\n");
    run.place.write("save.txt", "save " + run.out.path() + "/x.json\n");
    Words argv{CLEFT_BIN "/cleft-" + writer.command[0]};
    for (std::size_t i = 1; i < writer.command.size(); ++i) {
      const std::string& word = writer.command[i];
      const bool script = word.ends_with(".txt");
      argv.push_back(in_folder(word, script ? run.place.path() : in_->path(), run.out.path()));
    }
    auto environment = failure;
    environment["LD_PRELOAD"] = CLEFT_FAILING_WRITES;
    environment["CLEFT_FAIL_IN"] = run.out.path();
    run.result = run_process(argv, run.place / "log", environment);
    run.said = read_text_file(run.place / "log");
  }
  static std::unique_ptr<TemporaryFolder> in_;
};
std::unique_ptr<TemporaryFolder> FailingOutput::in_;

TEST_P(FailingOutput, IsWholeOrNotThere) {
  Run whole;
  run(whole, {{"CLEFT_FAIL_COUNT", whole.place / "events"}});
  ASSERT_TRUE(whole.result.success()) << whole.said;
  const std::string events = read_text_file(whole.place / "events");
  const auto count = std::count(events.begin(), events.end(), '\n');
  ASSERT_GE(count, 3) << "opened, written, flushed";
  const auto reference = files_in(whole.out.path());
  const std::string first = "1", middle = std::to_string(1 + count / 2), last = std::to_string(count);
  struct Failure {
    int with;
    std::string at;
  };
  for (const auto& [with, at] : {Failure{ENOSPC, middle},
                                 {EIO, last},
                                 {EACCES, first},
                                 {-SIGINT, first},
                                 {-SIGTERM, middle},
                                 {-SIGINT, last}}) {
    SCOPED_TRACE(std::string(with > 0 ? strerror(with) : strsignal(-with)) + " at " + at + " of " + last);
    Run failed;
    run(failed, {{"CLEFT_FAIL_AT", at}, {"CLEFT_FAIL_WITH", std::to_string(with)}});
    EXPECT_FALSE(failed.result.success());
    EXPECT_EQ(failed.result.signal, with < 0 ? -with : 0) << failed.said;
    if (with > 0) {
      EXPECT_NE(failed.said.find("cleft " + GetParam().command[0] + ": "), std::string::npos) << failed.said;
    }
    const auto left = files_in(failed.out.path());
    if (GetParam().output.empty()) {
      // Several files are moved one after the other, at the very end.
      EXPECT_TRUE(left.empty() || left.size() == reference.size()) << left.begin()->first;
      continue;
    }
    ASSERT_EQ(left.size(), 1U) << left.begin()->first;
    EXPECT_TRUE(left.begin()->second == "old" || left.begin()->second.size() > 3)
        << "neither the older file nor a whole one";
    if (with > 0 || at != last) {
      EXPECT_EQ(left.begin()->second, "old");
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Commands, FailingOutput, testing::ValuesIn(writers),
                         [](const auto& row) { return row.param.name; });

}  // namespace
}  // namespace cleft
