#include "base/memory.h"

#include <malloc.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>
#include <utility>

#include "base/error.h"
#include "base/text.h"

namespace cleft {

namespace {

/// The first number of a file; `otherwise` where there is none ("max").
double number_in(const std::string& path, double otherwise) {
  std::ifstream file(path);
  double number = 0;
  return file >> number ? number : otherwise;
}

}  // namespace

double parse_memory(const std::string& text, const std::string& option) {
  constexpr double least = 1e6;
  double unit = 1e9;
  std::string number = text;
  for (const auto& [name, bytes] : {std::pair("GB", 1e9), std::pair("MB", 1e6)})
    if (number.ends_with(name)) {
      number.resize(number.size() - 2), unit = bytes;
      break;
    }
  const double bytes = unit * parse_number(number, option);
  if (!(bytes >= least))
    throw InputError(option + " " + text + ": must be at least 1 MB, as 4, 4GB or 500MB");
  return bytes;
}

double memory_to_use(const std::string& text, const std::string& option) {
  return text.empty() ? 0.9 * available_memory() : parse_memory(text, option);
}

double available_memory() {
  constexpr double unlimited = std::numeric_limits<double>::infinity();
  double available = unlimited;
  std::ifstream file("/proc/meminfo");
  for (std::string name, unit; file >> name;) {
    double kilobytes = 0;
    file >> kilobytes;
    std::getline(file, unit);
    if (name == "MemAvailable:") available = 1024 * kilobytes;
  }
  for (const auto& [limit, used] :
       {std::pair("/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory.current"),
        {"/sys/fs/cgroup/memory/memory.limit_in_bytes", "/sys/fs/cgroup/memory/memory.usage_in_bytes"}})
    available = std::min(available, number_in(limit, unlimited) - number_in(used, 0));
  return std::max(0., available);
}

double peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024. * static_cast<double>(usage.ru_maxrss);
}

double held_memory() {
  std::ifstream file("/proc/self/statm");
  double all = 0, resident = 0;
  file >> all >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGE_SIZE));
}

void return_large_blocks() {
  mallopt(M_MMAP_MAX, 1 << 16);
  mallopt(M_MMAP_THRESHOLD, 16 << 20);  // vectors of a million unknowns still come from the heap, for speed
}

void keep_freed_blocks() {
  mallopt(M_MMAP_THRESHOLD, 32 << 20);  // the most there may be
  mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
}

}  // namespace cleft
