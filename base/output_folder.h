// Files and folders that appear complete or not at all.
#pragma once

#include <string>
#include <vector>

namespace cleft {

/// Write files and folders into path(), then commit() their names: all is flushed to disk and moved into
/// `folder`. Without a commit nothing remains, and existing files of these names are unchanged.
class OutputFolder {
 public:
  /// `name`: for the temporary folder and for messages. Throws InputError if `folder` does not exist or
  /// cannot be written.
  OutputFolder(std::string folder, const std::string& name);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  /// A hidden folder within `folder`, empty at first.
  const std::string& path() const { return temporary_; }
  /// Moves the names in this order and removes existing files of these names, for which the caller is
  /// responsible. If one cannot be moved, the earlier ones are moved back.
  void commit(const std::vector<std::string>& names);

 private:
  std::string folder_, temporary_;
};

}  // namespace cleft
