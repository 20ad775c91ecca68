// cleft check: verifies snapshots, fields and whole studies.
#include <filesystem>
#include <iostream>

#include "base/command.h"
#include "base/error.h"
#include "encoder/field/field_file.h"
#include "params/study_folder.h"
#include "solver/snapshot/snapshot.h"

using namespace cleft;

namespace {

void check_file(const std::string& file) {
  const std::string format = format_of(file);
  if (format == "cleft-snapshot")
    check_snapshot(file);
  else if (format == "cleft-field")
    read_field(file);
  else
    throw FileError(file, "is neither a snapshot nor a field");
}

void check_study(const std::string& path) {
  const StudyFolder folder(path);
  for (const std::string& hash : folder.published_cases()) {
    folder.verify(hash);
    for (const char* name : {"/case.h5", "/case.dffd"}) check_file(folder.published(hash) + name);
  }
}

/// Every mistake is told, not only the first.
void check_all(const std::vector<std::string>& places) {
  std::string mistakes;
  for (const std::string& place : places) try {
      if (std::filesystem::is_directory(place))
        check_study(place);
      else
        check_file(place);
      std::cout << place << ": sound\n";
    } catch (const InputError& e) {
      mistakes += (mistakes.empty() ? "" : "\n  ") + std::string(e.what());
    }
  if (!mistakes.empty()) throw InputError(mistakes);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "Reads every byte of files, or of a study's published cases, and verifies checksums and schemas.",
      "cleft check");
  std::vector<std::string> places;
  app.add_option("FILE|DIR", places, "snapshots, fields or study folders")->required();
  return run_command(app, argc, argv, [&] { check_all(places); });
}
