// What a signal leaves of a program that writes files and has children: nothing but what was whole.
#include "base/unfinished.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <functional>
#include <thread>

#include "base/output_file.h"
#include "base/output_folder.h"
#include "base/process.h"
#include "base/text.h"
#include "tests/support/temporary_folder.h"

namespace cleft {
namespace {

namespace fs = std::filesystem;

/// How a process ended that did `work` and then waited; it sends itself the signal.
int status_after(int signal, const std::function<void()>& work) {
  const pid_t child = fork();
  if (child == 0) {
    end_without_leftovers();
    work();
    kill(getpid(), signal);
    for (;;) pause();
  }
  int status = 0;
  waitpid(child, &status, 0);
  return status;
}

class UnfinishedOutput : public testing::TestWithParam<int> {};

TEST_P(UnfinishedOutput, IsRemovedAndWhatIsWholeStays) {
  const TemporaryFolder place;
  const int status = status_after(GetParam(), [&] {
    write_text_file(place / "whole.txt", "whole");
    auto* file = new OutputFile(place / "half.txt");  // NOLINT: its destructor is not to run
    std::ofstream(file->path()) << "half";
    auto* folder = new OutputFolder(place.path(), "series");  // NOLINT
    fs::create_directory(folder->path() + "/frames");
    std::ofstream(folder->path() + "/frames/0001.vtu") << "half";
  });
  ASSERT_TRUE(WIFSIGNALED(status));
  EXPECT_EQ(WTERMSIG(status), GetParam()) << "a shell is told by which signal";
  EXPECT_EQ(place.entries(), 1);
  EXPECT_EQ(read_text_file(place / "whole.txt"), "whole");
}

INSTANTIATE_TEST_SUITE_P(Signals, UnfinishedOutput, testing::Values(SIGINT, SIGTERM, SIGHUP));

TEST(UnfinishedOutputs, ChildrenEndFirst) {
  const TemporaryFolder place;
  const std::string folder = place / "work", id = place / "id";
  const int status = status_after(SIGINT, [&] {
    fs::create_directory(folder);
    begin_unfinished(folder);
    std::thread([&] {  // it writes again and again
      run_process({"sh", "-c", "echo $$ > " + id + "; while :; do mkdir -p " + folder + "/more; done"},
                  "/dev/null", {});
    })
        .detach();
    while (!fs::exists(folder + "/more")) usleep(1000);
  });
  EXPECT_EQ(WTERMSIG(status), SIGINT);
  EXPECT_FALSE(fs::exists(folder));
  const std::string process = "/proc/" + std::to_string(std::stoi(read_text_file(id)));
  for (int i = 0; i < 500 && fs::exists(process); ++i) usleep(10'000);
  EXPECT_FALSE(fs::exists(process));
}

TEST(UnfinishedOutputs, IgnoredSignalsStayIgnored) {
  const TemporaryFolder place;
  const int status = status_after(SIGTERM, [&] {
    signal(SIGHUP, SIG_IGN);
    const pid_t child = fork();
    if (child == 0) {
      end_without_leftovers();
      raise(SIGHUP);
      write_text_file(place / "lives.txt", "");
      _exit(0);
    }
    int ended = 0;
    waitpid(child, &ended, 0);
  });
  EXPECT_EQ(WTERMSIG(status), SIGTERM);
  EXPECT_TRUE(fs::exists(place / "lives.txt"));
}

}  // namespace
}  // namespace cleft
