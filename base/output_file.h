// A file that appears whole or not at all.
#pragma once

#include <string>
#include <vector>

namespace cleft {

/// Write to path(), then commit(): the file is flushed to disk and takes its final name in one step. Without
/// a commit (an exception on the way) nothing is left behind and an older file of that name stays as it was.
class OutputFile {
 public:
  /// Throws InputError where the folder does not exist or cannot be written.
  explicit OutputFile(std::string final_path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// The temporary name beside the final one, with the same ending.
  const std::string& path() const { return temporary_; }
  void commit();

 private:
  std::string final_, temporary_;
  bool committed_ = false;
};

/// Throws InputError where a file to be written is one of those that are read: the input would be lost.
void refuse_to_overwrite(const std::string& out, const std::vector<std::string>& inputs);

/// Throws InputError, as a sentence about `output`, where `folder` does not exist or cannot be written.
void check_output_folder(const std::string& folder, const std::string& output);

/// Writes `text` to `path` through an OutputFile.
void write_text_file(const std::string& path, const std::string& text);

/// fsync on a file or folder; throws std::runtime_error with the path where the system refuses.
void flush_to_disk(const std::string& path);

}  // namespace cleft
