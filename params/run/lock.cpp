#include "params/run/lock.h"

#include <fcntl.h>
#include <pwd.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <utility>
#include <vector>

#include "base/error.h"

namespace cleft {

namespace fs = std::filesystem;

namespace {

/// "alice", or "user 1000".
std::string owner_of(const struct stat& file) {
  std::vector<char> buffer(1 << 14);
  passwd entry{}, *found = nullptr;
  if (getpwuid_r(file.st_uid, &entry, buffer.data(), buffer.size(), &found) == 0 && found)
    return found->pw_name;
  return "user " + std::to_string(file.st_uid);
}

[[noreturn]] void refuse(const std::string& path, int error) {
  std::string what = path + ": could not be locked: " + std::strerror(error);
  struct stat file {};
  if (stat(path.c_str(), &file) == 0 && file.st_uid != geteuid())
    what += "; it belongs to " + owner_of(file) + ", who can chmod g+rw it";
  else if (stat(path.c_str(), &file) != 0 && stat(fs::path(path).parent_path().c_str(), &file) == 0 &&
           file.st_uid != geteuid())
    what += "; its folder belongs to " + owner_of(file) + ", who can chmod g+rwxs it for your group";
  throw std::runtime_error(what);
}

/// What a folder's group may do, its files' group may do; failures show where another user cannot lock.
void share_as(const fs::path& folder, int file, mode_t mask) {
  struct stat parent {
  }, made{};
  if (stat(folder.c_str(), &parent) != 0 || fstat(file, &made) != 0) return;
  if (made.st_gid != parent.st_gid && fchown(file, static_cast<uid_t>(-1), parent.st_gid) != 0) return;
  const mode_t wanted = parent.st_mode & mask;
  if ((made.st_mode & mask) != wanted) fchmod(file, wanted);
}

/// Reading suffices to lock. -1 and errno where it cannot be opened.
int open_existing(const std::string& path) {
  const int file = open(path.c_str(), O_RDWR | O_CLOEXEC);
  return file >= 0 ? file : open(path.c_str(), O_RDONLY | O_CLOEXEC);
}

/// Makes it where there is none. -1 and errno likewise.
int open_lock(const std::string& path) {
  constexpr mode_t of_files = 0666;
  const int made = open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, of_files);
  if (made >= 0) {
    share_as(fs::path(path).parent_path(), made, of_files);
    return made;
  }
  const int why = errno;
  if (why != EEXIST && why != EACCES && why != EROFS) return -1;
  const int file = open_existing(path);
  if (file < 0 && errno == ENOENT) errno = why;  // there is none, and none can be made
  return file;
}

/// Waits.
void lock(int file, const std::string& path) {
  while (flock(file, LOCK_EX) != 0)
    if (errno != EINTR) {
      const int error = errno;
      close(file);
      refuse(path, error);
    }
}

}  // namespace

Lock::Lock(const std::string& path) : file_(open_lock(path)) {
  if (file_ >= 0 && flock(file_, LOCK_EX | LOCK_NB) == 0) return;
  const int error = errno;
  if (file_ >= 0) close(file_);
  refuse(path, error);
}

Lock::~Lock() {
  if (file_ >= 0) close(file_);
}

Lock& Lock::operator=(Lock&& other) noexcept {
  std::swap(file_, other.file_);
  return *this;
}

bool Lock::is_held(const std::string& path) {
  const int file = open_existing(path);
  if (file < 0) return errno == EACCES;
  const bool held = flock(file, LOCK_EX | LOCK_NB) != 0;
  close(file);
  return held;
}

Moment::Moment(const std::string& study, const std::string& file) : file_(open_lock(study + file)) {
  if (file_ < 0) refuse(study + file, errno);
  lock(file_, study + file);
}

Moment Moment::to_look(const std::string& study) {
  const std::string path = study + "/.lock";
  const int file = open_lock(path);
  const int error = errno;
  if (file < 0 && fs::exists(path)) refuse(path, error);
  if (file >= 0) lock(file, path);
  return Moment(file);
}

Moment::~Moment() {
  if (file_ >= 0) close(file_);
}

void make_shared_folder(const std::string& parent, const std::string& name) {
  constexpr mode_t of_folders = 07777;
  const std::string path = parent + "/" + name;
  if (!fs::create_directory(path)) return;
  const int folder = open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder < 0) return;
  share_as(parent, folder, of_folders);
  close(folder);
}

void check_file_system(const std::string& folder) {
  const std::string place = folder + "/.probe." + std::to_string(getpid());
  const auto refuse = [&](const std::string& what) {
    std::error_code ignored;
    fs::remove_all(place, ignored);
    throw InputError(folder + ": " + what +
                     "; give --out on another file system (a local disk; NFS with locks; Lustre mounted with "
                     "flock), and copy the study afterwards");
  };
  try {
    fs::create_directories(place + "/one");
    fs::create_directories(place + "/other");
    for (const char* name : {"/one/file", "/other/file"}) std::ofstream(place + name) << name;
    const Lock lock(place + "/lock");
    if (!Lock::is_held(place + "/lock")) refuse("a lock on this file system keeps nobody out");
  } catch (const std::runtime_error& e) {
    if (dynamic_cast<const InputError*>(&e)) throw;
    refuse(std::string("the file system lacks what a study needs: ") + e.what());
  }
  std::error_code refused;
  fs::rename(place + "/one", place + "/other", refused);
  if (!refused) refuse("this file system lets a folder take the place of one that is not empty");
  fs::remove_all(place, refused);
}

}  // namespace cleft
