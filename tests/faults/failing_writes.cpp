// Loaded before the C library (LD_PRELOAD): writes to files, and flushes of them, fail.
//
//   CLEFT_FAILING_WRITES=N         now and then, one in N, with EIO
//   CLEFT_FAIL_IN=FOLDER           counts events of files in FOLDER:
//   CLEFT_FAIL_COUNT=FILE              each is a line of FILE
//   CLEFT_FAIL_AT=N                    the Nth fails (and all after it, if the error is EACCES)
//   CLEFT_FAIL_WITH=NUMBER             with this error number, or by the signal -NUMBER
//
// Events are openings for writing, writes and flushes. (libfiu, which does the like, locks itself up where a
// program loads libraries of its own, as Open MPI does.)
#include <dlfcn.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <sys/uio.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <climits>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>

namespace {

template <class Function>
Function original(const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

bool is_counted(const char* path) {
  static const char* folder = std::getenv("CLEFT_FAIL_IN");
  return folder && std::strncmp(path, folder, std::strlen(folder)) == 0;
}

/// Long enough for a signal to end the program, which must not go on meanwhile.
void wait_for_the_end() {
  constexpr int seconds = 20;
  for (int i = 0; i < seconds; ++i) sleep(1);
}

/// Counts an event; whether it is the one that fails.
bool fails_now() {
  static std::atomic<int> count{0};
  static const char *at = std::getenv("CLEFT_FAIL_AT"), *with = std::getenv("CLEFT_FAIL_WITH"),
                    *log = std::getenv("CLEFT_FAIL_COUNT");
  const int number = ++count;
  if (log) {
    static const auto call = original<ssize_t (*)(int, const void*, size_t)>("write");
    static const auto to = original<int (*)(const char*, int, ...)>("open")(
        log, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
    if (call(to, "event\n", 6) != 6) std::abort();
  }
  if (!at || !with) return false;
  // Rights do not come back: a library that opens a file again in another way is refused again.
  const int how = std::atoi(with), first = std::atoi(at);
  if (how == EACCES ? number < first : number != first) return false;
  if (how < 0) {
    kill(getpid(), -how);
    wait_for_the_end();
  }
  errno = how < 0 ? EINTR : how;
  return true;
}

bool fails(int file) {
  static const char* rate = std::getenv("CLEFT_FAILING_WRITES");
  static std::atomic<unsigned> count{static_cast<unsigned>(getpid()) * 2654435761U +
                                     static_cast<unsigned>(time(nullptr))};
  struct stat kind;
  if (fstat(file, &kind) != 0 || !(S_ISREG(kind.st_mode) || S_ISDIR(kind.st_mode))) return false;
  char link[64], path[PATH_MAX];
  std::snprintf(link, sizeof link, "/proc/self/fd/%d", file);
  const ssize_t length = readlink(link, path, sizeof path - 1);
  path[length < 0 ? 0 : length] = 0;
  if (is_counted(path)) return fails_now();
  if (!rate || !S_ISREG(kind.st_mode)) return false;
  const unsigned n = ++count * 2246822519U;
  if ((n >> 8) % static_cast<unsigned>(std::atoi(rate)) != 0) return false;
  errno = EIO;
  return true;
}

bool opening_fails(const char* path, bool to_write) { return to_write && is_counted(path) && fails_now(); }

using Open = int (*)(const char*, int, ...);
using FileOpen = FILE* (*)(const char*, const char*);

int opened(const char* name, const char* path, int flags, mode_t mode) {
  if (opening_fails(path, (flags & (O_WRONLY | O_RDWR)) != 0)) return -1;
  return original<Open>(name)(path, flags, mode);
}

FILE* file_opened(const char* name, const char* path, const char* mode) {
  if (opening_fails(path, std::strpbrk(mode, "wa+") != nullptr)) return nullptr;
  return original<FileOpen>(name)(path, mode);
}

}  // namespace

extern "C" {

int open(const char* path, int flags, ...) {
  va_list more;
  va_start(more, flags);
  const mode_t mode = (flags & (O_CREAT | O_TMPFILE)) ? va_arg(more, mode_t) : 0;
  va_end(more);
  return opened("open", path, flags, mode);
}

int open64(const char* path, int flags, ...) {
  va_list more;
  va_start(more, flags);
  const mode_t mode = (flags & (O_CREAT | O_TMPFILE)) ? va_arg(more, mode_t) : 0;
  va_end(more);
  return opened("open64", path, flags, mode);
}

FILE* fopen(const char* path, const char* mode) { return file_opened("fopen", path, mode); }
FILE* fopen64(const char* path, const char* mode) { return file_opened("fopen64", path, mode); }

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
