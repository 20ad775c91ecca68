// A study on Slurm, where there is one.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <map>

#include "base/text.h"
#include "tests/pipeline/commands.h"
#include "tests/support/small_study.h"
#include "tests/support/temporary_folder.h"

namespace cleft {

namespace fs = std::filesystem;

namespace {

const std::string slurm_study = std::string(small_study) + R"([slurm]
time = "10"
cases_per_task = 1
)";

bool slurm_is_here() { return in_shell("sinfo -h | grep -q idle").exit_code == 0; }

/// Largest number of tasks in an array of this cluster.
int most_tasks() {
  return std::stoi(in_shell("scontrol show config | sed -n 's/^MaxArraySize *= *//p'").output);
}

int arrays_of(const std::string& folder) {
  int count = 0;
  if (fs::exists(folder + "/slurm"))
    for (const auto& entry : fs::directory_iterator(folder + "/slurm")) count += entry.is_directory();
  return count;
}

}  // namespace

TEST(Slurm, PublishesWhatALocalRunDoesAndFindsItsJobsAgain) {
  if (!slurm_is_here()) GTEST_SKIP() << "no Slurm here (sinfo names no idle node)";
  const TemporaryFolder place;
  const std::string file = place.write("study.toml", slurm_study), folder = place / "slurm";
  expect_success(run_cleft("run", {file, "--out", place / "local"}));

  constexpr int cases = 4;  // of the small study, each a task
  const int arrays = (cases + most_tasks() - 1) / most_tasks();
  const pid_t child = fork();
  if (child == 0) {
    execl(CLEFT_BIN "/cleft", "cleft", "run", file.c_str(), "--out", folder.c_str(), "--launcher", "slurm",
          nullptr);
    _exit(127);
  }
  for (int i = 0; i < 200 && arrays_of(folder) < arrays; ++i) usleep(50'000);
  usleep(500'000);
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);

  expect_success(run_cleft("run", {file, "--out", folder, "--launcher", "slurm"}));
  EXPECT_EQ(arrays_of(folder), arrays) << "the jobs of the killed run were not found";
  EXPECT_TRUE(published_bytes(folder) == published_bytes(place / "local"));
  expect_success(run_cleft("check", {folder}));

  const Outcome refused = run_cleft(
      "run", {file, "--out", place / "other", "--launcher", "slurm", "--partition", "no-such-partition"});
  EXPECT_EQ(refused.exit_code, 2) << refused.output;
  EXPECT_NE(refused.output.find("partition"), std::string::npos) << refused.output;
}

}  // namespace cleft
