// A study of four cases that takes seconds, and what a run of a study has published.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "base/text.h"

namespace cleft {

constexpr const char* small_study = R"(
[case]
patch.length = 12
patch.width = 8
patch.height = 4
cut.length = 6
cut.depth = 2
mesh.element_size = 2
[vary]
"tissue.young_modulus" = [0.01, 0.03]
"skin.prestress_v" = [0.02, 0.04]
[encode]
tolerance = 0.1
)";

/// Of the files of all published cases by their names in the study's folder; but the manifests, which tell
/// times, and logs, in which libraries may name the machine.
inline std::map<std::string, std::string> published_bytes(const std::string& folder) {
  namespace fs = std::filesystem;
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder + "/cases"))
    if (entry.is_regular_file() && entry.path().filename() != "manifest.json" &&
        entry.path().extension() != ".log")
      files[fs::relative(entry.path(), folder).string()] = read_text_file(entry.path().string());
  return files;
}

}  // namespace cleft
