#include "base/memory_file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <vector>

#include "base/output_file.h"

namespace cleft {

namespace {

/// All of it, or an error number.
int written(int file, const char* data, std::size_t size) {
  while (size > 0) {
    const ssize_t count = write(file, data, size);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return count < 0 ? errno : ENOSPC;
    data += count, size -= static_cast<std::size_t>(count);
  }
  return 0;
}

int copied(int from, int to) {
  std::vector<char> part(1 << 20);
  off_t at = 0;
  for (;;) {
    const ssize_t count = pread(from, part.data(), part.size(), at);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return errno;
    if (count == 0) return 0;
    if (const int error = written(to, part.data(), static_cast<std::size_t>(count))) return error;
    at += count;
  }
}

}  // namespace

MemoryFile::MemoryFile() : file_(memfd_create("cleft", MFD_CLOEXEC)) {
  if (file_ < 0) throw std::runtime_error(std::string("no file in memory can be made: ") + strerror(errno));
  path_ = "/proc/" + std::to_string(getpid()) + "/fd/" + std::to_string(file_);
}

MemoryFile::~MemoryFile() { close(file_); }

void MemoryFile::copy_to(const std::string& to) const {
  OutputFile out(to);
  const int file = open(out.path().c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  int error = file < 0 ? errno : copied(file_, file);
  if (file >= 0 && close(file) != 0 && error == 0) error = errno;
  if (error != 0) throw std::runtime_error(to + ": could not be written: " + strerror(error));
  out.commit();
}

void write_through_memory(const std::string& path, const std::function<void(const std::string&)>& write) {
  { const OutputFile probe(path); }
  const MemoryFile file;
  write(file.path());
  file.copy_to(path);
}

}  // namespace cleft
