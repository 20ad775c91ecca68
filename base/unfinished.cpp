#include "base/unfinished.h"

#include <fcntl.h>
#include <pthread.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <ctime>
#include <filesystem>
#include <thread>
#include <vector>

namespace cleft {

namespace fs = std::filesystem;

namespace {

constexpr int ending_signals[] = {SIGINT, SIGTERM, SIGHUP};

struct Registry {
  std::mutex mutex;
  std::vector<std::string> paths;
  std::vector<pid_t> children;
};

/// Never destroyed: a signal may come while the program ends.
Registry& registry() {
  static Registry* const all = new Registry;  // NOLINT(cppcoreguidelines-owning-memory)
  return *all;
}

pid_t owner = 0;
int wake_up[2] = {-1, -1};

/// Only what a handler may call. The work is done by a thread, which may lock and allocate.
void on_signal(int number) {
  const int kept = errno;
  const auto byte = static_cast<char>(number);
  if (getpid() != owner || write(wake_up[1], &byte, 1) != 1) {  // a child before it has become its program
    signal(number, SIG_DFL);
    raise(number);
  }
  errno = kept;
}

void kill_children(const std::vector<pid_t>& children) {
  constexpr int most_polls = 200;
  constexpr timespec pause{0, 10'000'000};
  for (const pid_t child : children) kill(-child, SIGKILL), kill(child, SIGKILL);
  for (const pid_t child : children)
    for (int poll = 0; poll < most_polls; ++poll) {
      siginfo_t ended{};
      if (waitid(P_PID, static_cast<id_t>(child), &ended, WEXITED | WNOHANG | WNOWAIT) != 0) break;
      if (ended.si_pid == child) break;
      nanosleep(&pause, nullptr);
    }
}

/// Other threads go on meanwhile, and may make files in a folder while it is removed.
void remove_unfinished(const std::vector<std::string>& paths) {
  constexpr int rounds = 5;
  std::error_code ignored;
  for (const std::string& path : paths)
    for (int round = 0; round < rounds && fs::exists(fs::symlink_status(path, ignored)); ++round)
      fs::remove_all(path, ignored);
}

void end_when_told() {
  char number = 0;
  while (read(wake_up[0], &number, 1) != 1) {
  }
  Registry& all = registry();
  all.mutex.lock();  // for ever: nothing takes its final name any more
  kill_children(all.children);
  remove_unfinished(all.paths);
  signal(number, SIG_DFL);
  kill(owner, number);
  for (;;) pause();
}

}  // namespace

void end_without_leftovers() {
  if (owner == getpid()) return;
  if (pipe2(wake_up, O_CLOEXEC) != 0) return;  // signals then end the program as they always do
  registry();
  owner = getpid();
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_BLOCK, &all, &before);
  std::thread(end_when_told).detach();
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  for (const int number : ending_signals) {
    struct sigaction old = {}, action = {};
    action.sa_handler = on_signal;
    action.sa_flags = SA_RESTART;
    if (sigaction(number, nullptr, &old) == 0 && old.sa_handler == SIG_DFL)
      sigaction(number, &action, nullptr);
  }
}

void wait_if_ending() { const std::lock_guard guard(registry().mutex); }

std::unique_lock<std::mutex> not_while_ending() { return std::unique_lock(registry().mutex); }

void begin_unfinished(const std::string& path) {
  const std::lock_guard guard(registry().mutex);
  registry().paths.push_back(fs::absolute(path).string());
}

void end_unfinished(const std::string& path) {
  const std::lock_guard guard(registry().mutex);
  std::vector<std::string>& paths = registry().paths;
  const auto found = std::find(paths.begin(), paths.end(), fs::absolute(path).string());
  if (found != paths.end()) paths.erase(found);
}

Unfinished::Unfinished(std::string path) : path_(std::move(path)) { begin_unfinished(path_); }
Unfinished::~Unfinished() { end_unfinished(path_); }

UnfinishedChild::UnfinishedChild(pid_t leader) : leader_(leader) {
  const std::lock_guard guard(registry().mutex);
  registry().children.push_back(leader_);
}

UnfinishedChild::~UnfinishedChild() {
  const std::lock_guard guard(registry().mutex);
  std::vector<pid_t>& children = registry().children;
  children.erase(std::find(children.begin(), children.end(), leader_));
}

}  // namespace cleft
