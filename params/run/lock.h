// Locks between processes: on the attempt that one of them works in, and on a study for a moment.
#pragma once

#include <string>

namespace cleft {

/// A file that is locked (flock) while its owner lives, so that a killed run is told from a running one.
class Lock {
 public:
  explicit Lock(const std::string& path);
  ~Lock();
  Lock(Lock&& other) noexcept : file_(other.file_) { other.file_ = -1; }
  Lock& operator=(Lock&& other) noexcept;
  static bool is_held(const std::string& path);

 private:
  int file_;
};

/// Held for the moment in which attempts come, go, are published or looked at, by all processes of a study;
/// or, with another file, in which something else is done by one of them at a time. Waits for it.
class Moment {
 public:
  explicit Moment(const std::string& study, const std::string& file = "/.lock");
  ~Moment();
  Moment(const Moment&) = delete;
  Moment& operator=(const Moment&) = delete;

 private:
  int file_;
};

/// Throws InputError where the file system under a folder does not do what publishing relies on: a lock keeps
/// others out, and a folder does not take the place of one that is not empty.
void check_file_system(const std::string& folder);

}  // namespace cleft
