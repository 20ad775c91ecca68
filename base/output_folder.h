// Files and folders that appear whole or not at all.
#pragma once

#include <string>
#include <vector>

namespace cleft {

/// Write files and folders into path(), then commit() their names: all is flushed to disk and moved into
/// `folder`. Without a commit nothing is left behind, and what had these names before stays as it was.
class OutputFolder {
 public:
  /// `name`: for the temporary folder and for messages. Throws InputError where `folder` does not exist or
  /// cannot be written.
  OutputFolder(std::string folder, const std::string& name);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  /// A hidden folder within `folder`, empty at first.
  const std::string& path() const { return temporary_; }
  /// Moves in this order, each over what has its name, which is then removed. Where one cannot be moved,
  /// those before are moved back. The caller has made sure that what is replaced may go.
  void commit(const std::vector<std::string>& names);

 private:
  std::string folder_, temporary_;
};

}  // namespace cleft
