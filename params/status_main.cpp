// cleft status: what of a study is done.
#include <iostream>

#include "base/command.h"
#include "params/case_list.h"

using namespace cleft;

namespace {

Json status_of(const StudyFolder& folder) {
  const Study study = read_study(folder.study_file());
  Json result = {{"study", study.name}, {"published", 0}, {"running", 0},
                 {"failed", 0},         {"missing", 0},   {"cases", Json::array()}};
  for (const Case& one : cases_of(study)) {
    const CaseStatus status = folder.status(one.hash());
    result["cases"].push_back(case_entry(study, one, status));
    int count = result[to_text(status.state)];
    result[to_text(status.state)] = count + 1;
  }
  return result;
}

void print_table(const Json& status) {
  print_cases(status["cases"]);
  for (const char* state : {"published", "running", "failed", "missing"})
    std::cout << state << ": " << status[state] << "\n";
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Shows which cases of a study are published, running, failed or missing.", "cleft status");
  std::string folder;
  bool json = false;
  app.add_option("DIR", folder, "study folder")->required();
  app.add_flag("--json", json, "print as JSON");
  return run_command(app, argc, argv, [&] {
    const Json status = status_of(StudyFolder(folder));
    if (json)
      std::cout << status.dump(2) << "\n";
    else
      print_table(status);
  });
}
