// cleft status: what of a study is done.
#include <iostream>

#include "base/command.h"
#include "params/study_folder.h"

using namespace cleft;

namespace {

Json status_of(const StudyFolder& folder) {
  const Study study = read_study(folder.study_file());
  Json result = {{"study", study.name}, {"published", 0}, {"running", 0},
                 {"failed", 0},         {"missing", 0},   {"cases", Json::array()}};
  for (const Case& one : cases_of(study)) {
    const CaseStatus status = folder.status(one.hash());
    const std::string state = to_text(status.state);
    result[state] = result[state].get<int>() + 1;
    Json entry = {{"case", one.hash()}, {"state", state}};
    if (!status.reason.empty()) entry["reason"] = status.reason;
    for (const Variation& v : study.vary)
      entry[v.name] = to_text(get_parameter(one.parameters, find_parameter(v.name, study.name)));
    result["cases"].push_back(entry);
  }
  return result;
}

void print_table(const Json& status) {
  for (const Json& entry : status["cases"]) {
    for (const auto& [name, value] : entry.items())
      std::cout << (name == "case" || name == "state" ? "" : name + "=") << value.get<std::string>() << "  ";
    std::cout << "\n";
  }
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
