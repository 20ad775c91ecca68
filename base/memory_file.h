// Files that libraries write which do not tell of a full disk, or crash over one.
#pragma once

#include <functional>
#include <string>

namespace cleft {

/// A file in this process's memory, which this process and its children can open by its path.
class MemoryFile {
 public:
  MemoryFile();
  ~MemoryFile();
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  const std::string& path() const { return path_; }
  /// Writes what it holds to `to`, through an OutputFile. Throws std::runtime_error where it cannot.
  void copy_to(const std::string& to) const;

 private:
  int file_;
  std::string path_;
};

/// Lets `write` write to the path of a file in memory that it is given, and then copies that file to `path`.
/// Names that cannot be written are reported before.
void write_through_memory(const std::string& path, const std::function<void(const std::string&)>& write);

}  // namespace cleft
