#include "base/output_folder.h"

#include <unistd.h>

#include <filesystem>

#include "base/error.h"
#include "base/output_file.h"
#include "base/unfinished.h"

namespace cleft {

namespace fs = std::filesystem;

namespace {

constexpr const char* replaced = ".replaced.";

void flush_all(const std::string& folder) {
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
    flush_to_disk(entry.path().string());
}

}  // namespace

OutputFolder::OutputFolder(std::string folder, const std::string& name)
    : folder_(std::move(folder)),
      temporary_((fs::path(folder_) / ("." + name + "." + std::to_string(getpid()) + ".part")).string()) {
  const std::string output = (fs::path(folder_) / name).string();
  check_output_folder(folder_, output);
  fs::remove_all(temporary_);  // of a killed process that had our number
  std::error_code refused;
  if (!fs::create_directory(temporary_, refused))
    throw InputError(output + ": the folder '" + folder_ + "' cannot be written: " + refused.message());
  begin_unfinished(temporary_);
}

OutputFolder::~OutputFolder() {
  std::error_code ignored;
  fs::remove_all(temporary_, ignored);
  end_unfinished(temporary_);
}

void OutputFolder::commit(const std::vector<std::string>& names) {
  flush_all(temporary_);
  auto whole = not_while_ending();
  std::vector<std::pair<fs::path, fs::path>> moves;
  const auto move = [&moves](const fs::path& from, const fs::path& to) {
    fs::rename(from, to);
    moves.emplace_back(from, to);
  };
  try {
    for (const std::string& name : names) {
      const fs::path ready = fs::path(temporary_) / name, final = fs::path(folder_) / name;
      if (fs::exists(fs::symlink_status(final))) move(final, fs::path(temporary_) / (replaced + name));
      move(ready, final);
    }
  } catch (const fs::filesystem_error&) {
    std::error_code ignored;
    for (auto last = moves.rbegin(); last != moves.rend(); ++last)
      fs::rename(last->second, last->first, ignored);
    throw;
  }
  whole.unlock();
  flush_to_disk(folder_);
}

}  // namespace cleft
