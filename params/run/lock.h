// Locks between processes, also of several users of one group: on an attempt, and on a study.
#pragma once

#include <string>

namespace cleft {

/// A file that is locked (flock) during the lifetime of its owner, which distinguishes a running process from
/// a killed one. The file gets the group and the mode of its folder, so that whoever may write the folder may
/// lock it, whatever the umask of its maker. Throws std::runtime_error naming the file's owner where the lock
/// cannot be had.
class Lock {
 public:
  explicit Lock(const std::string& path);
  ~Lock();
  Lock(Lock&& other) noexcept : file_(other.file_) { other.file_ = -1; }
  Lock& operator=(Lock&& other) noexcept;
  /// A lock that may not be looked at counts as held: it is another user's.
  static bool is_held(const std::string& path);

 private:
  int file_;
};

/// A mutex between all processes of a study, held while attempts are created, removed, published or listed,
/// or, with another file, for another exclusive operation. Waits for the lock, and throws std::runtime_error
/// naming the file's owner where it cannot be had.
class Moment {
 public:
  explicit Moment(const std::string& study, const std::string& file = "/.lock");
  /// For a look only: in a folder that cannot be written and has no lock nobody is to be kept out.
  static Moment to_look(const std::string& study);
  ~Moment();
  Moment(const Moment&) = delete;
  Moment& operator=(const Moment&) = delete;

 private:
  explicit Moment(int file) : file_(file) {}
  int file_;
};

/// Makes a folder in `parent` with the group and the mode of that. Throws as the standard library does.
void make_shared_folder(const std::string& parent, const std::string& name);

/// Throws InputError if the file system of a folder does not satisfy the requirements of publishing: a lock
/// excludes others, and a rename does not replace a folder that is not empty.
void check_file_system(const std::string& folder);

}  // namespace cleft
