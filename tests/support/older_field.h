// A published case as an earlier version of the program left it.
#pragma once

#include <filesystem>
#include <string>

#include "base/file_versions.h"
#include "base/h5/h5.h"
#include "base/output_file.h"

namespace cleft {

/// In the folder of a study, under a name.
inline void publish_older_case(const std::string& study, const std::string& name) {
  const std::string folder = study + "/cases/" + name;
  std::filesystem::create_directories(folder);
  write_text_file(folder + "/manifest.json",
                  R"({"version": 1, "snapshot": "dropped", "files": {}, "case": ")" + name + "\"}");
  h5::File file = h5::File::create(folder + "/case.dffd");
  write_format(file, {"cleft-field", field_version - 1, "", ""});
  file.close();
}

}  // namespace cleft
