// cleft status: what of a study is done.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

#include "base/command/command.h"
#include "params/run/case_list.h"
#include "params/run/chosen_cases.h"

using namespace cleft;

namespace {

/// What is known of a published case at a glance; null where it is not known.
void add_figures(Json& entry, const IndexedCase& known) {
  const auto figure = [](double value) { return value > 0 ? Json(value) : Json(); };
  entry["node_error"] = figure(known.node_error);
  entry["largest_displacement_mm"] = figure(known.largest_displacement);
  entry["bytes"] = static_cast<std::int64_t>(known.bytes);
  entry["seconds"] = figure(known.seconds);
  entry["raw_data"] = known.snapshot ? "kept" : "dropped";
}

/// Of adaptive sampling: the estimated error by the number of cases, and how many more would be enough.
void add_errors(Json& status, const Study& study, const ChosenCases& chosen) {
  if (chosen.batches.empty()) return;
  Json& sampling = status["sampling"] = {{"figure", chosen.figure}, {"error_wanted", study.sampling.error}};
  for (const ChosenBatch& one : chosen.batches)
    sampling["errors"].push_back({{"cases", one.cases}, {"error", one.error}});
  for (const double error : {study.sampling.error, study.sampling.error / 2})
    if (const auto cases = cases_for(chosen, error))
      sampling["cases_expected"].push_back({{"error", error}, {"cases", *cases}});
}

Json status_of(const StudyFolder& folder, bool with_figures) {
  const Study study = read_study(folder.study_file());
  Json result = {{"study", study.name}, {"published", 0}, {"running", 0},          {"failed", 0},
                 {"missing", 0},        {"damaged", 0},   {"cases", Json::array()}};
  const std::vector<Case> cases = cases_of(study, folder);
  const auto index = folder.index();
  std::vector<CaseStatus> states = folder.status(cases, index);
  for (std::size_t c = 0; c < cases.size(); ++c) {
    const std::string hash = cases[c].hash();
    if (const auto why =
            std::filesystem::exists(folder.published(hash)) ? folder.damage(hash, true) : std::nullopt)
      states[c] = {CaseState::damaged, *why + "; cleft run makes the case again"};
  }
  for (std::size_t c = 0; c < cases.size(); ++c) {
    result["cases"].push_back(case_entry(study, cases[c], states[c]));
    if (const auto known = index.find(cases[c].hash()); with_figures && known != index.end())
      add_figures(result["cases"].back(), known->second);
    auto& count = result[to_text(states[c].state)].get_ref<Json::number_integer_t&>();
    ++count;
  }
  const auto dropped = [](const auto& published) { return !published.second.snapshot; };
  if (const auto count = std::count_if(index.begin(), index.end(), dropped))
    result["without_snapshot"] = count;
  add_errors(result, study, chosen_cases(folder, study));
  return result;
}

std::string csv_cell(const Json& value) {
  if (value.is_null()) return "";
  if (!value.is_string()) return value.dump();
  std::string text = value.get<std::string>();
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  for (std::size_t at = 0; (at = text.find('"', at)) != std::string::npos; at += 2) text.insert(at, 1, '"');
  return '"' + text + '"';
}

/// RFC 4180, with a column for each name that any case has; what a case lacks is empty.
void print_csv(const Json& cases) {
  std::vector<std::string> columns;
  for (const Json& entry : cases)
    for (const auto& [name, value] : entry.items())
      if (std::find(columns.begin(), columns.end(), name) == columns.end()) columns.push_back(name);
  for (std::size_t k = 0; k < columns.size(); ++k) std::cout << (k ? "," : "") << csv_cell(columns[k]);
  std::cout << "\n";
  for (const Json& entry : cases) {
    for (std::size_t k = 0; k < columns.size(); ++k)
      std::cout << (k ? "," : "") << csv_cell(entry.value(columns[k], Json()));
    std::cout << "\n";
  }
}

void print_errors(const Json& sampling) {
  std::cout << "estimated error of " << sampling["figure"].get<std::string>() << ", "
            << sampling["error_wanted"] << " wanted:";
  const auto print = [](const Json& list) {
    for (const Json& one : list)
      std::cout << (one == list[0] ? " " : ", ") << std::round(1e4 * one["error"].get<double>()) / 1e4
                << " by " << one["cases"] << " cases";
  };
  print(sampling["errors"]);
  if (sampling.contains("cases_expected")) std::cout << "; expected:", print(sampling["cases_expected"]);
  std::cout << "\n";
}

void print_table(const Json& status) {
  print_cases(status["cases"]);
  for (const char* state : {"published", "running", "failed", "missing"})
    std::cout << state << ": " << status[state] << "\n";
  if (status["damaged"] > 0) std::cout << "damaged: " << status["damaged"] << "\n";
  if (status.contains("sampling")) print_errors(status["sampling"]);
  if (status.contains("without_snapshot"))
    std::cout << "raw data are gone (keep_snapshots = \"none\"): " << status["without_snapshot"] << "\n";
}

}  // namespace

int main(int argc, char** argv) {
  CommandLine app("Shows which cases of a study are published, running, failed or missing.", "cleft status");
  std::string folder;
  bool json = false, csv = false;
  app.add_option("DIR", folder, "study folder")->required();
  auto* as_json = app.add_flag("--json", json, "print as JSON, with what is known of published cases");
  app.add_flag("--csv", csv, "print the cases as CSV, likewise: hash, state, parameters that vary, figures")
      ->excludes(as_json);
  return run_command(app, argc, argv, [&] {
    const Json status = status_of(StudyFolder(folder), json || csv);
    if (json)
      std::cout << status.dump(2) << "\n";
    else if (csv)
      print_csv(status["cases"]);
    else
      print_table(status);
  });
}
