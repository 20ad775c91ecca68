// Loaded before the C library (LD_PRELOAD): now and then a write to a file, or a flush of one, fails.
// CLEFT_FAILING_WRITES is one in how many. (libfiu, which does the like, locks itself up where a program
// loads libraries of its own, as Open MPI does.)
#include <dlfcn.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <sys/uio.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <ctime>

namespace {

bool fails(int file) {
  static const char* rate = std::getenv("CLEFT_FAILING_WRITES");
  static std::atomic<unsigned> count{static_cast<unsigned>(getpid()) * 2654435761U +
                                     static_cast<unsigned>(time(nullptr))};
  struct stat kind;
  if (!rate || fstat(file, &kind) != 0 || !S_ISREG(kind.st_mode)) return false;
  const unsigned n = ++count * 2246822519U;
  if ((n >> 8) % static_cast<unsigned>(std::atoi(rate)) != 0) return false;
  errno = EIO;
  return true;
}

template <class Function>
Function original(const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

}  // namespace

extern "C" {

ssize_t write(int file, const void* data, size_t size) {
  static const auto call = original<ssize_t (*)(int, const void*, size_t)>("write");
  return fails(file) ? -1 : call(file, data, size);
}

ssize_t writev(int file, const iovec* parts, int count) {
  static const auto call = original<ssize_t (*)(int, const iovec*, int)>("writev");
  return fails(file) ? -1 : call(file, parts, count);
}

ssize_t pwrite(int file, const void* data, size_t size, off_t at) {
  static const auto call = original<ssize_t (*)(int, const void*, size_t, off_t)>("pwrite");
  return fails(file) ? -1 : call(file, data, size, at);
}

ssize_t pwrite64(int file, const void* data, size_t size, off64_t at) {
  static const auto call = original<ssize_t (*)(int, const void*, size_t, off64_t)>("pwrite64");
  return fails(file) ? -1 : call(file, data, size, at);
}

int fsync(int file) {
  static const auto call = original<int (*)(int)>("fsync");
  return fails(file) ? -1 : call(file);
}
}
