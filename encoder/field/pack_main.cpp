// cleft pack: the fields of a study's published cases in one file.
#include <filesystem>

#include "base/command.h"
#include "encoder/field/study_file.h"

using namespace cleft;

namespace fs = std::filesystem;

int main(int argc, char** argv) {
  CLI::App app("Writes the fields of a study's published cases into one file, DIR/study.dffd.", "cleft pack");
  std::string folder;
  bool json = false;
  app.add_option("DIR", folder, "study folder")->required();
  app.add_flag("--json", json, "print the figures as JSON");
  return run_command(app, argc, argv, [&] {
    const std::vector<StudyCase> cases = published_fields(folder);
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
