// A file that appears complete or not at all.
#pragma once

#include <string>
#include <vector>

namespace cleft {

/// Write to path(), then commit(): the file is flushed to disk and takes its final name in one step. Without
/// a commit (because of an exception) no file remains, and an older file of that name is unchanged.
class OutputFile {
 public:
  /// Throws InputError if the folder does not exist or cannot be written.
  explicit OutputFile(std::string final_path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// The temporary name in the same folder, with the same ending.
  const std::string& path() const { return temporary_; }
  void commit();

 private:
  std::string final_, temporary_;
  bool committed_ = false;
};

/// Throws InputError if an output is also an input, which would be lost.
void refuse_to_overwrite(const std::string& out, const std::vector<std::string>& inputs);

/// Where the results of `inputs` go: to `out` for one, which may be a folder; for several to files of a
/// folder `out`, each under its input's name with another `ending`. `kind`: what an input is, in messages.
/// Throws InputError if there is no such folder, or two inputs have one name.
std::vector<std::string> outputs_of(const std::vector<std::string>& inputs, const std::string& out,
                                    const std::string& ending, const std::string& kind);

/// Throws InputError about `output` if `folder` does not exist or cannot be written.
void check_output_folder(const std::string& folder, const std::string& output);

/// Writes `text` to `path` through an OutputFile.
void write_text_file(const std::string& path, const std::string& text);

/// fsync on a file or folder; throws std::runtime_error with the path if the system refuses.
void flush_to_disk(const std::string& path);

}  // namespace cleft
