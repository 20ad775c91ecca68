#include "tests/accuracy/references.h"

#include <algorithm>
#include <filesystem>

namespace cleft {

namespace {

const std::string folder = CLEFT_SOURCE "/tests/accuracy";

}  // namespace

std::vector<std::string> solved_references() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder + "/cases"))
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

std::string case_file(const std::string& name) { return folder + "/cases/" + name + ".toml"; }

std::vector<std::string> references() {
  std::vector<std::string> names = solved_references();
  names.insert(names.end(), {"imported", "uncut"});
  return names;
}

std::string accuracy_file() { return folder + "/accuracy.csv"; }

}  // namespace cleft
