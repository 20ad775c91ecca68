// cleft status: what of a study is done.
#include <algorithm>
#include <iostream>

#include "base/command/command.h"
#include "params/run/case_list.h"

using namespace cleft;

namespace {

Json status_of(const StudyFolder& folder) {
  const Study study = read_study(folder.study_file());
  Json result = {{"study", study.name}, {"published", 0}, {"running", 0},
                 {"failed", 0},         {"missing", 0},   {"cases", Json::array()}};
  const std::vector<Case> cases = cases_of(study);
  const auto index = folder.index();
  const std::vector<CaseStatus> states = folder.status(cases, index);
  for (std::size_t c = 0; c < cases.size(); ++c) {
    result["cases"].push_back(case_entry(study, cases[c], states[c]));
    auto& count = result[to_text(states[c].state)].get_ref<Json::number_integer_t&>();
    ++count;
  }
  const auto dropped = [](const auto& published) { return !published.second.snapshot; };
  if (const auto count = std::count_if(index.begin(), index.end(), dropped))
    result["without_snapshot"] = count;
  return result;
}

void print_table(const Json& status) {
  print_cases(status["cases"]);
  for (const char* state : {"published", "running", "failed", "missing"})
    std::cout << state << ": " << status[state] << "\n";
  if (status.contains("without_snapshot"))
    std::cout << "raw data are gone (keep_snapshots = \"none\"): " << status["without_snapshot"] << "\n";
}

}  // namespace

int main(int argc, char** argv) {
  CommandLine app("Shows which cases of a study are published, running, failed or missing.", "cleft status");
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
