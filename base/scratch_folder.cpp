#include "base/scratch_folder.h"

#include <stdlib.h>  // mkdtemp

#include <filesystem>
#include <stdexcept>

#include "base/unfinished.h"

namespace cleft {

namespace fs = std::filesystem;

ScratchFolder::ScratchFolder(const std::string& purpose) {
  std::string name = (fs::temp_directory_path() / ("cleft-" + purpose + "-XXXXXX")).string();
  if (!mkdtemp(name.data())) throw std::runtime_error(name + ": a temporary folder cannot be made");
  path_ = name;
  begin_unfinished(path_);
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
  end_unfinished(path_);
}

}  // namespace cleft
