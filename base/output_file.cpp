#include "base/output_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <set>

#include "base/error.h"
#include "base/unfinished.h"

namespace cleft {

namespace fs = std::filesystem;

std::vector<std::string> outputs_of(const std::vector<std::string>& inputs, const std::string& out,
                                    const std::string& ending, const std::string& kind) {
  if (inputs.size() == 1 && !fs::is_directory(out)) return {out};
  if (!fs::is_directory(out))
    throw InputError("--out " + out + ": must be a folder that exists, for " + std::to_string(inputs.size()) +
                     " " + kind + "s");
  std::vector<std::string> files;
  std::set<std::string> names;
  for (const std::string& file : inputs) {
    const std::string name = fs::path(file).stem().string() + ending;
    if (!names.insert(name).second)
      throw InputError(
          std::string(file).append(": another ").append(kind).append(" is called ").append(name) +
          " too; rename one");
    files.push_back((fs::path(out) / name).string());
  }
  return files;
}

void check_output_folder(const std::string& folder, const std::string& output) {
  if (!fs::is_directory(folder))
    throw InputError(output + ": the folder '" + folder + "' does not exist; create it first");
  if (access(folder.c_str(), W_OK) != 0)
    throw InputError(output + ": the folder '" + folder + "' cannot be written");
}

OutputFile::OutputFile(std::string final_path) : final_(std::move(final_path)) {
  const fs::path target(final_);
  const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
  if (target.filename().empty() || fs::is_directory(target))
    throw InputError(final_ + ": is a folder; give a file name");
  if (fs::exists(target) && !fs::is_regular_file(target))
    throw InputError(final_ + ": exists and is not a file; give another name");
  check_output_folder(folder.string(), final_);
  temporary_ = (folder / ("." + target.stem().string() + "." + std::to_string(getpid()) + ".part" +
                          target.extension().string()))
                   .string();
  begin_unfinished(temporary_);
}

OutputFile::~OutputFile() {
  std::error_code ignored;
  if (!committed_) fs::remove(temporary_, ignored);
  end_unfinished(temporary_);
}

void OutputFile::commit() {
  flush_to_disk(temporary_);
  const auto whole = not_while_ending();
  fs::rename(temporary_, final_);
  committed_ = true;
}

void refuse_to_overwrite(const std::string& out, const std::vector<std::string>& inputs) {
  std::error_code absent;
  for (const std::string& input : inputs)
    if (fs::equivalent(out, input, absent))
      throw InputError("--out " + out + ": is the input; give another name");
}

void write_text_file(const std::string& path, const std::string& text) {
  OutputFile out(path);
  std::ofstream file(out.path(), std::ios::binary);
  file << text;
  file.close();
  if (!file) throw std::runtime_error(path + ": could not be written: is the disk full?");
  out.commit();
}

void flush_to_disk(const std::string& path) {
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  const bool done = file >= 0 && fsync(file) == 0;
  const int error = errno;
  if (file >= 0) close(file);
  if (!done) throw std::runtime_error(path + ": could not be flushed to disk: " + std::strerror(error));
}

}  // namespace cleft
