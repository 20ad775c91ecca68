// cleft pack: the fields of a study's published cases in one file.
#include <algorithm>
#include <filesystem>

#include "base/command.h"
#include "base/error.h"
#include "encoder/field/study_file.h"

using namespace cleft;

namespace {

namespace fs = std::filesystem;

std::vector<StudyCase> published_cases(const std::string& study) {
  if (!fs::is_directory(study)) throw InputError(study + ": no such folder (give a study folder)");
  std::vector<StudyCase> cases;
  std::error_code absent;
  for (const fs::directory_entry& entry : fs::directory_iterator(fs::path(study) / "cases", absent))
    if (fs::exists(entry.path() / "manifest.json") && fs::exists(entry.path() / "case.dffd"))
      cases.push_back({entry.path().filename().string(), (entry.path() / "case.dffd").string()});
  if (cases.empty())
    throw InputError(study +
                     ": no published case (looked for cases/*/case.dffd with manifest.json); run `cleft run "
                     "STUDY.toml --out " +
                     study + "` first");
  std::sort(cases.begin(), cases.end(),
            [](const StudyCase& a, const StudyCase& b) { return a.name < b.name; });
  return cases;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Writes the fields of a study's published cases into one file, DIR/study.dffd.", "cleft pack");
  std::string folder;
  bool json = false;
  app.add_option("DIR", folder, "study folder")->required();
  app.add_flag("--json", json, "print the figures as JSON");
  return run_command(app, argc, argv, [&] {
    const std::vector<StudyCase> cases = published_cases(folder);
    const std::string out = (fs::path(folder) / "study.dffd").string();
    write_study(out, cases);
    const StudyFile file(out);
    std::size_t coefficients = 0;
    for (int i = 0; i < file.size(); ++i) coefficients += file.coefficient_bytes(i);
    print_figures({{"file", out},
                   {"cases", file.size()},
                   {"bytes", fs::file_size(out)},
                   {"bytes_of_coefficients", coefficients}},
                  json);
  });
}
