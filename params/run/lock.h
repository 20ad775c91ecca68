// Locks between processes: on an attempt, and on a study.
#pragma once

#include <string>

namespace cleft {

/// A file that is locked (flock) during the lifetime of its owner, which distinguishes a running process from
/// a killed one.
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

/// A mutex between all processes of a study, held while attempts are created, removed, published or listed,
/// or, with another file, for another exclusive operation. Waits for the lock.
class Moment {
 public:
  explicit Moment(const std::string& study, const std::string& file = "/.lock");
  ~Moment();
  Moment(const Moment&) = delete;
  Moment& operator=(const Moment&) = delete;

 private:
  int file_;
};

/// Throws InputError if the file system of a folder does not satisfy the requirements of publishing: a lock
/// excludes others, and a rename does not replace a folder that is not empty.
void check_file_system(const std::string& folder);

}  // namespace cleft
