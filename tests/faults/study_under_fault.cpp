#include "tests/faults/study_under_fault.h"

#include <filesystem>

#include "base/error.h"
#include "base/output_file.h"
#include "base/text.h"
#include "params/run/study_folder.h"
#include "tests/support/small_study.h"

namespace cleft::faults {

namespace fs = std::filesystem;

namespace {

std::map<std::string, std::string> bytes_of(const std::string& folder) {
  std::map<std::string, std::string> files = published_bytes(folder);
  files["study.dffd"] = read_text_file(folder + "/study.dffd");
  return files;
}

}  // namespace

StudyUnderFault::StudyUnderFault(std::string place, int ranks) : place_(std::move(place)), ranks_(ranks) {
  write_text_file(place_ + "/study.toml", small_study);
  const bool done = run(reference()).success();
  promise(done, "the undisturbed run failed: " + read_text_file(reference() + ".log"));
  undisturbed_ = bytes_of(reference());
}

std::vector<std::string> StudyUnderFault::command(const std::string& folder) const {
  return {CLEFT_BIN "/cleft",    "run", place_ + "/study.toml", "--out", folder, "--jobs", "2", "--ranks",
          std::to_string(ranks_)};
}

ProcessResult StudyUnderFault::run(const std::string& folder, const std::vector<std::string>& before) const {
  std::vector<std::string> argv = before;
  for (const std::string& word : command(folder)) argv.push_back(word);
  return run_process(argv, folder + ".log", {});
}

void StudyUnderFault::finish(const std::string& folder) const {
  constexpr int most_runs = 3;
  ProcessResult result;
  for (int i = 0; i < most_runs; ++i)
    if ((result = run(folder)).success()) return expect_as_undisturbed(folder);
  throw Broken("cleft run does not finish " + folder + ": " + read_text_file(folder + ".log"));
}

std::map<std::string, std::string> StudyUnderFault::published(const std::string& folder) const {
  std::map<std::string, std::string> tokens;
  if (!fs::exists(folder + "/study.toml")) return tokens;
  const StudyFolder opened(folder);
  for (const std::string& hash : opened.published_cases())
    tokens[hash] = opened.manifest(hash).at("token").get<std::string>();
  return tokens;
}

void StudyUnderFault::expect_as_undisturbed(const std::string& folder) const {
  const std::string log = folder + ".check.log";
  const bool sound = run_process({CLEFT_BIN "/cleft", "check", folder}, log, {}).success();
  promise(sound, "cleft check: " + read_text_file(log));
  promise(fs::is_empty(folder + "/attempts"), folder + ": an attempt is left");
  const auto files = bytes_of(folder);
  for (const auto& [name, bytes] : undisturbed_) {
    promise(files.contains(name), folder + "/" + name + " is missing");
    promise(files.at(name) == bytes, folder + "/" + name + " differs from the undisturbed run's");
  }
  promise(files.size() == undisturbed_.size(), folder + ": holds other files than the undisturbed run");
}

}  // namespace cleft::faults
