// Two users of one group run one study at the same time, with the commands themselves.
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>

#include "base/text.h"
#include "tests/pipeline/commands.h"
#include "tests/support/temporary_folder.h"

namespace cleft {
namespace {

namespace fs = std::filesystem;

constexpr int first = 61001, second = 61002, group = 61100;

/// A folder of the group, setgid, and commands of which the solver waits until the file "go" is there.
class TwoUsers : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    if (geteuid() != 0) GTEST_SKIP() << "only root may act as two users";
    fs::permissions(place_.path(), fs::perms::others_read | fs::perms::others_exec, fs::perm_options::add);
    fs::create_directory(bin_);
    for (const char* name : {"", "-run", "-status", "-solve", "-encode", "-check", "-pack"})
      fs::copy_file(std::string(CLEFT_BIN "/cleft") + name, bin_ + "/cleft" + name);
    fs::rename(bin_ + "/cleft-solve", bin_ + "/solver");
    stand_in("cleft-solve",
             "while [ ! -e " + go_ + " ]; do sleep 0.05; done\nexec " + bin_ + "/solver \"$@\"\n");
    for (const std::string& folder : {shared_, shared_ + "/study"}) {
      fs::create_directory(folder);
      ASSERT_EQ(chown(folder.c_str(), first, group), 0);
      ASSERT_EQ(chmod(folder.c_str(), 02775), 0);
    }
    place_.write("shared/study.toml",
                 "[case]\nmesh.element_size = 5\n[vary]\n'skin.prestress_v' = [0.02, 0.03, 0.04]\n");
  }
  void stand_in(const std::string& name, const std::string& script) const {
    fs::remove(bin_ + "/" + name);
    place_.write("bin/" + name, "#!/bin/sh\n" + script);
    fs::permissions(bin_ + "/" + name,
                    fs::perms::owner_all | fs::perms::others_read | fs::perms::others_exec);
  }
  /// A command line of the shell that a user runs with the test's umask.
  std::string as(int user, const std::string& command) const {
    const std::string id = std::to_string(user);
    return "setpriv --reuid " + id + " --regid " + id + " --groups " + std::to_string(group) +
           " sh -c 'umask " + GetParam() + "; cd " + shared_ + "; HOME=" + shared_ + " " + bin_ + "/" +
           command + "'";
  }
  const TemporaryFolder place_;
  const std::string bin_ = place_ / "bin", shared_ = place_ / "shared", go_ = place_ / "go",
                    study_ = shared_ + "/study";
};

TEST_P(TwoUsers, BothRunsEndWellAndNothingIsLost) {
  const std::string run = "cleft run study.toml --out study --jobs 1";
  // The second begins while all cases are the first one's, and none is published.
  const std::string begun = "[ \"$(ls " + study_ + "/attempts 2> /dev/null)\" ]";
  const Outcome both =
      in_shell(as(first, run) + " > " + (place_ / "said") + " 2>&1 & maker=$!\nfor i in $(seq 400); do " +
               begun + " && break; sleep 0.05; done\n" + as(second, run) + "; code=$?\ntouch " + go_ +
               "\nwait $maker && exit $code");
  EXPECT_EQ(both.exit_code, 0) << both.output << read_text_file(place_ / "said");
  EXPECT_NE(both.output.find("3 of 3 cases are being run by another process, which packs them at its end"),
            std::string::npos)
      << both.output;
  const auto info = figures_of(expect_success(run_cleft("info", {study_ + "/study.dffd", "--json"})));
  EXPECT_EQ(info["cases"], 3);
  // Each may go on with what the other has made.
  EXPECT_EQ(in_shell(as(second, run)).exit_code, 0);
  expect_success(run_cleft("check", {study_}));
}

TEST_P(TwoUsers, TheLogOfAPackingThatFailedIsReplacedByTheOther) {
  const std::string run = "cleft run study.toml --out study --jobs 1", log = study_ + "/pack.log";
  place_.write("go", "");
  stand_in("cleft-pack", "id -u >&2\nexit 1\n");
  for (const int user : {first, second}) {
    const Outcome outcome = in_shell(as(user, run));
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_NE(outcome.output.find("could not be packed into study/study.dffd; study/pack.log says why"),
              std::string::npos)
        << outcome.output;
    EXPECT_EQ(read_text_file(log), std::to_string(user) + "\n");
  }
}

INSTANTIATE_TEST_SUITE_P(Umasks, TwoUsers, testing::Values("002", "022"));

}  // namespace
}  // namespace cleft
