// Children that end when they are told to, and when nobody is left to tell them.
#include "base/process.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <thread>

#include "base/stopwatch.h"
#include "base/text.h"
#include "tests/support/temporary_folder.h"

namespace cleft {
namespace {

bool lives(int process) {
  // A zombie that waits for its parent to look has ended.
  const std::string file = "/proc/" + std::to_string(process) + "/stat";
  if (!std::filesystem::exists(file)) return false;
  const std::string text = read_text_file(file);
  return text[text.rfind(')') + 2] != 'Z';
}

int number_in(const std::string& file) {
  for (int i = 0; i < 500 && (!std::filesystem::exists(file) || std::filesystem::file_size(file) == 0); ++i)
    usleep(10'000);
  return std::stoi(read_text_file(file));
}

bool ends_within(int process, double seconds) {
  for (const Stopwatch watch; watch.seconds() < seconds; usleep(10'000))
    if (!lives(process)) return true;
  return false;
}

}  // namespace

TEST(Process, TellsHowItsChildEnded) {
  const TemporaryFolder place;
  EXPECT_EQ(run_process({"sh", "-c", "echo out; echo err >&2; exit 3"}, place / "log", {}).exit_code, 3);
  EXPECT_EQ(read_text_file(place / "log"), "out\nerr\n");
  const ProcessResult apart = run_process({"sh", "-c", "echo $WORD; echo err >&2"}, place / "log",
                                          {{"WORD", "out"}}, nullptr, place / "out");
  EXPECT_TRUE(apart.success());
  EXPECT_GT(apart.peak_memory, 1e5);
  EXPECT_EQ(read_text_file(place / "log"), "err\n");
  EXPECT_EQ(read_text_file(place / "out"), "out\n");
  EXPECT_EQ(run_process({"sh", "-c", "kill -11 $$"}, place / "log", {}).signal, SIGSEGV);
  EXPECT_THROW(run_process({"no-such-program"}, place / "log", {}), std::runtime_error);
}

TEST(Process, IsAskedToEndAndThenMadeTo) {
  const TemporaryFolder place;
  StopCount stop = 0;
  const std::string deaf = "trap '' TERM; echo $$ > " + (place / "id") + "; while :; do sleep 0.1; done";
  std::thread asking([&] {
    number_in(place / "id");
    stop = 1;
    usleep(300'000);
    EXPECT_TRUE(lives(number_in(place / "id"))) << "SIGTERM does not reach it";
    stop = 2;
  });
  EXPECT_EQ(run_process({"sh", "-c", deaf}, place / "log", {}, &stop).signal, SIGKILL);
  asking.join();
  stop = 1;
  EXPECT_EQ(run_process({"sleep", "60"}, place / "log", {}, &stop).signal, SIGTERM);
}

TEST(Process, IsMadeToEndWhereItDoesNotFollow) {
  const TemporaryFolder place;
  StopCount stop = 0;
  std::thread asks([&] {  // once it ignores the signal, and never again
    while (!std::filesystem::exists(place / "ready"))
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    stop = 1;
  });
  const std::string command = "trap '' TERM; touch " + place / "ready" + "; sleep 60 & wait; wait; sleep 60";
  EXPECT_EQ(run_process({"sh", "-c", command}, place / "log", {}, &stop).signal, SIGKILL);
  asks.join();
}

TEST(Process, DoesNotOutliveTheOneThatStartedIt) {
  const TemporaryFolder place;
  const pid_t driver = fork();
  if (driver == 0) {
    run_process({"sh", "-c", "echo $$ > " + (place / "id") + "; exec sleep 60"}, place / "log", {});
    _exit(0);
  }
  const int child = number_in(place / "id");
  EXPECT_TRUE(lives(child));
  kill(driver, SIGKILL);
  waitpid(driver, nullptr, 0);
  EXPECT_TRUE(ends_within(child, 10));
}

}  // namespace cleft
