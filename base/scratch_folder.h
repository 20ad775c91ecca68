// A folder of the system's temporary files.
#pragma once

#include <string>

namespace cleft {

/// It is removed with all that it contains, also if a signal ends the program (unfinished.h).
class ScratchFolder {
 public:
  /// `purpose`: a part of its name. Throws std::runtime_error if it cannot be made.
  explicit ScratchFolder(const std::string& purpose);
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  const std::string& path() const { return path_; }
  std::string operator/(const std::string& name) const { return path_ + "/" + name; }

 private:
  std::string path_;
};

}  // namespace cleft
