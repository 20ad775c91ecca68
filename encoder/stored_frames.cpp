#include "encoder/stored_frames.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>

#include "base/error.h"

namespace cleft {

namespace {

std::size_t page_size() { return static_cast<std::size_t>(::sysconf(_SC_PAGESIZE)); }

}  // namespace

SpillFile::SpillFile(const std::string& folder) : folder_(folder) {
  std::string name = folder + "/.cleft-XXXXXX";
  file_ = ::mkstemp(name.data());
  if (file_ < 0)
    throw InputError(folder + ": no temporary file can be made there: " + std::strerror(errno) +
                     "; name another folder with TMPDIR");
  ::unlink(name.c_str());
}

SpillFile::~SpillFile() {
  for (const auto& [begin, bytes] : maps_) ::munmap(begin, bytes);
  ::close(file_);
}

double* SpillFile::room(std::size_t numbers) {
  const std::size_t page = page_size(), bytes = (numbers * sizeof(double) + page - 1) / page * page;
  if (bytes == 0) return nullptr;
  // Blocks are reserved: a full disk is told here, and not by a signal when numbers are written.
  if (const int error = ::posix_fallocate(file_, static_cast<off_t>(size_), static_cast<off_t>(bytes)))
    throw std::runtime_error(folder_ + ": the temporary file of the frames cannot grow to " +
                             std::to_string((size_ + bytes) / 1000000) + " MB: " + std::strerror(error) +
                             "; name another folder with TMPDIR");
  void* begin = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, file_, static_cast<off_t>(size_));
  if (begin == MAP_FAILED) throw std::runtime_error(folder_ + ": the temporary file cannot be mapped");
  size_ += bytes;
  maps_.emplace_back(begin, bytes);
  return static_cast<double*>(begin);
}

void SpillFile::forget(const double* numbers, std::size_t count) {
  if (!numbers) return;
  const std::size_t page = page_size(), bytes = (count * sizeof(double) + page - 1) / page * page;
  ::madvise(const_cast<double*>(numbers), bytes, MADV_DONTNEED);
}

}  // namespace cleft
