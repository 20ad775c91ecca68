// Files and folders without their final name, and child processes: none outlives a program that a signal
// ends.
#pragma once

#include <sys/types.h>

#include <mutex>
#include <string>

namespace cleft {

/// From now on SIGINT, SIGTERM and SIGHUP end this program when its children have been killed and what is
/// unfinished has been removed; it then ends by the same signal, as a shell expects. A signal that was
/// ignored before (nohup) is ignored. Handlers that are installed later take precedence.
void end_without_leftovers();

/// Does not return if that has begun: the program is about to end by the signal.
void wait_if_ending();

/// While it is held nothing is removed: for the step in which an output takes its name.
[[nodiscard]] std::unique_lock<std::mutex> not_while_ending();

/// A path that is removed, with all that a folder contains, if a signal ends the program meanwhile.
class Unfinished {
 public:
  explicit Unfinished(std::string path);
  ~Unfinished();
  Unfinished(const Unfinished&) = delete;
  Unfinished& operator=(const Unfinished&) = delete;

 private:
  std::string path_;
};

/// The same for classes without a member for it.
void begin_unfinished(const std::string& path);
void end_unfinished(const std::string& path);

/// The leader of a group of processes that is killed if a signal ends this program.
class UnfinishedChild {
 public:
  explicit UnfinishedChild(pid_t leader);
  ~UnfinishedChild();
  UnfinishedChild(const UnfinishedChild&) = delete;
  UnfinishedChild& operator=(const UnfinishedChild&) = delete;

 private:
  pid_t leader_;
};

}  // namespace cleft
