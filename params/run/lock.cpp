#include "params/run/lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <utility>

#include "base/error.h"

namespace cleft {

namespace fs = std::filesystem;

namespace {

int open_lock(const std::string& path) { return open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644); }

}  // namespace

Lock::Lock(const std::string& path) : file_(open_lock(path)) {
  if (file_ >= 0 && flock(file_, LOCK_EX | LOCK_NB) == 0) return;
  const int error = errno;
  if (file_ >= 0) close(file_);
  throw std::runtime_error(path + ": could not be locked: " + std::strerror(error));
}

Lock::~Lock() {
  if (file_ >= 0) close(file_);
}

Lock& Lock::operator=(Lock&& other) noexcept {
  std::swap(file_, other.file_);
  return *this;
}

bool Lock::is_held(const std::string& path) {
  const int file = open(path.c_str(), O_RDWR | O_CLOEXEC);
  if (file < 0) return false;
  const bool held = flock(file, LOCK_EX | LOCK_NB) != 0;
  close(file);
  return held;
}

Moment::Moment(const std::string& study, const std::string& file) : file_(open_lock(study + file)) {
  while (file_ >= 0 && flock(file_, LOCK_EX) != 0)
    if (errno != EINTR) {
      const int error = errno;
      close(file_);
      throw std::runtime_error(study + file + ": could not be locked: " + std::strerror(error));
    }
}

Moment::~Moment() {
  if (file_ >= 0) close(file_);
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
