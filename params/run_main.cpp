// cleft run: a study file to a folder of published cases.
#include <filesystem>
#include <iostream>
#include <thread>

#include "base/command.h"
#include "base/error.h"
#include "base/process.h"
#include "params/case_list.h"
#include "params/launcher/local.h"
#include "params/study.h"

using namespace cleft;

namespace {

void list_cases(const Study& study, const std::vector<Case>& cases, const std::string& out, bool as_json) {
  const bool exists = std::filesystem::exists(out + "/study.toml");
  Json list = Json::array();
  for (const Case& one : cases)
    list.push_back(case_entry(study, one, exists ? StudyFolder(out).status(one.hash()) : CaseStatus{}));
  if (as_json) return print_figures({{"cases", list}}, true);
  print_cases(list);
  std::cout << cases.size() << " cases\n";
}

Json figures_of(const RunReport& r) {
  return {{"cases", r.cases},         {"already_published", r.already_published},
          {"published", r.published}, {"superseded", r.superseded},
          {"failed", r.failed},       {"interrupted", r.interrupted}};
}

/// Its published fields in one file, out/study.dffd.
void pack(const std::string& out) {
  const std::string log = out + "/pack.log";
  if (!run_process({executable_folder() + "/cleft-pack", out}, log, {}).success())
    throw std::runtime_error("the study's fields could not be packed into " + out + "/study.dffd; " + log +
                             " says why");
  std::filesystem::remove(log);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Runs every case of a study and publishes it. Run again, it finishes what is missing.",
               "cleft run");
  std::string file, out, launcher = "local";
  LocalOptions options;
  options.jobs = 0;
  bool dry_run = false, json = false;
  app.add_option("STUDY.toml", file, "study file")->required();
  app.add_option("--out", out, "study folder")->required();
  app.add_option("--jobs", options.jobs, "cases at a time (default: as many as there are cores)")
      ->check(CLI::Range(1, 4096));
  app.add_option("--ranks", options.ranks, "MPI ranks of each solve")
      ->check(CLI::Range(1, 4096))
      ->capture_default_str();
  app.add_option("--launcher", launcher, "where cases run")
      ->check(CLI::IsMember({"local"}))
      ->capture_default_str();
  app.add_flag("--dry-run", dry_run, "print the cases and their state, run nothing");
  app.add_flag("--json", json, "print the figures as JSON");

  return run_command(app, argc, argv, [&] {
    const Study study = read_study(file);
    const std::vector<Case> cases = cases_of(study);
    if (dry_run) return list_cases(study, cases, out, json);
    if (options.jobs == 0)
      options.jobs = std::max(1, static_cast<int>(std::thread::hardware_concurrency()) / options.ranks);
    const RunReport report = run_local(StudyFolder::create(out, study), cases, options);
    if (report.interrupted == 0 && report.already_published + report.published + report.superseded > 0)
      pack(out);
    print_figures(figures_of(report), json);
    if (report.failed > 0)
      throw std::runtime_error(std::to_string(report.failed) + " of " + std::to_string(report.cases) +
                               " cases failed; cleft status " + out + " says why");
    if (report.interrupted > 0) throw std::runtime_error("interrupted; run the same command again to finish");
  });
}
