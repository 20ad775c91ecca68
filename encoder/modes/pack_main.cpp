// cleft pack: the fields of a study's published cases in one file.
#include <algorithm>
#include <filesystem>
#include <iostream>

#include "base/command/command.h"
#include "base/error.h"
#include "base/text.h"
#include "encoder/field/file/study_file.h"
#include "encoder/modes/common_modes.h"
#include "params/encode_limits.h"

using namespace cleft;

namespace fs = std::filesystem;

int main(int argc, char** argv) {
  CommandLine app("Writes the fields of a study's published cases into one file, DIR/study.dffd.",
                  "cleft pack");
  std::string folder;
  double error = 0;
  bool json = false;
  app.add_option("DIR", folder, "study folder")->required();
  app.add_option("--modes", error,
                 "make the cases of modes that they have in common, or of coarser steps, if that costs fewer "
                 "bytes: no node of a case moves by more than this times its largest displacement (0.0001 "
                 "to 0.1)");
  app.add_flag("--json", json, "print the figures as JSON");
  return run_command(app, argc, argv, [&] {
    if (app.count("--modes") && !(error >= least_pack_error && error <= greatest_pack_error))
      throw InputError("--modes " + shortest(error) + ": must be from 0.0001 to 0.1");
    std::vector<std::string> older, damaged;
    const std::vector<StudyCase> cases = published_study_cases(folder, &older, &damaged);
    if (!damaged.empty()) std::cerr << "cleft pack: warning: " << note_of_damaged(folder, damaged) << "\n";
    if (!older.empty()) std::cerr << "cleft pack: " << note_of_older(folder, older) << "\n";
    Progress progress("packing");
    PackedStudy study;
    for (std::size_t i = 0; i < cases.size(); ++i) {
      progress("case " + std::to_string(i + 1) + " of " + std::to_string(cases.size()));
      study.cases.push_back(std::move(study_records({cases[i]}).front()));
    }
    if (error > 0) {
      progress("finding common modes");
      study = with_common_modes(study, error);
    }
    progress("writing");
    const std::string out = (fs::path(folder) / "study.dffd").string();
    write_study(out, study.cases, study.modes);
    const StudyFile file(out);
    Json figures{{"file", out},
                 {"cases", file.size()},
                 {"bytes", fs::file_size(out)},
                 {"bytes_of_coefficients", coefficient_bytes(study)}};
    if (error > 0) {
      double largest_error = 0;
      for (int i = 0; i < file.size(); ++i) largest_error = std::max(largest_error, file.modes_error(i));
      figures["modes"] = file.modes(), figures["modes_error"] = largest_error;
    }
    print_figures(figures, json);
  });
}
