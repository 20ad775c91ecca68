// cleft run: a study file to a folder of published cases.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <thread>

#include "base/command/command.h"
#include "base/error.h"
#include "base/memory.h"
#include "base/text.h"
#include "params/run/case_list.h"
#include "params/run/chosen_cases.h"
#include "params/run/estimates.h"
#include "params/run/local.h"
#include "params/run/packing.h"
#include "params/run/run_table.h"
#include "params/run/slurm.h"
#include "params/study.h"

using namespace cleft;

namespace {

/// The cases, what is done of them, and what the rest will take by what measured ones took.
void list_cases(const Study& study, const std::vector<Case>& cases, const std::string& out, int jobs,
                bool as_json) {
  const bool exists = std::filesystem::exists(out + "/study.toml");
  std::vector<CaseStatus> states(cases.size());
  Estimates estimates;
  if (exists) {
    const auto index = StudyFolder(out).index();
    states = StudyFolder(out).status(cases, index), estimates = Estimates(index);
  }
  Json list = Json::array();
  std::size_t published = 0;
  double seconds = 0, bytes = 0;
  for (std::size_t c = 0; c < cases.size(); ++c) {
    list.push_back(case_entry(study, cases[c], states[c]));
    if (states[c].state == CaseState::published) {
      ++published;
      continue;
    }
    const CaseSize size = size_of(cases[c].parameters);
    seconds += estimates.seconds(size).value_or(0), bytes += estimates.bytes(size).value_or(0);
  }
  const bool measured = estimates.seconds({1, 1}).has_value();
  Json figures = {{"cases", list}, {"published", published}, {"to_run", cases.size() - published}};
  figures["estimated_seconds"] = measured ? Json(std::round(seconds / jobs)) : Json();
  figures["estimated_bytes"] = measured ? Json(std::round(bytes)) : Json();
  if (as_json) return print_figures(figures, true);
  print_cases(list);
  std::cout << cases.size() << " cases, " << published << " of them published\n";
  if (published == cases.size()) return;
  if (measured)
    std::cout << "the others: about " << as_clock(seconds / jobs) << " with --jobs " << jobs << ", and "
              << std::ceil(bytes / 1e5) / 10 << " MB on disk, as measured so far\n";
  else
    std::cout << "no case of the study has been measured: what they will take is not known yet\n";
}

std::vector<Case> known_cases(const Study& study, const std::string& out) {
  return std::filesystem::exists(out + "/study.toml") ? cases_of(study, StudyFolder(out)) : cases_of(study);
}

/// After a run of all cases so far, of which those before the last batch had been published or had failed.
RunReport with_batch(const RunReport& before, const RunReport& last) {
  RunReport sum = last;
  sum.already_published = before.already_published;
  sum.published = before.published + last.published, sum.superseded = before.superseded + last.superseded;
  return sum;
}

void tell(const Decision& decision, const Study& study, int cases) {
  const std::string error = shortest(std::round(1e4 * decision.error) / 1e4),
                    what = study.sampling.of + ": estimated error " + error + " by " + std::to_string(cases) +
                           " cases";
  if (decision.choice == Choice::added) std::cerr << what << "; choosing more\n";
  if (decision.choice == Choice::reached)
    std::cerr << what << ", within " << shortest(study.sampling.error) << " everywhere in the ranges\n";
  if (decision.choice == Choice::most)
    std::cerr << "cleft run: warning: " << what << ", the most that the study may have; "
              << shortest(study.sampling.error) << " is not reached\n";
  if (decision.choice == Choice::exhausted)
    std::cerr << "cleft run: warning: " << what
              << "; no place is left at which a further case would tell more\n";
  if (decision.choice == Choice::failed)
    std::cerr << "cleft run: warning: every case of the last batch failed; no more are chosen\n";
}

/// Packs what is published, if anything is, and tells how many cases another run has not published yet.
void pack_published(const StudyFolder& folder, const std::vector<Case>& cases, double pack_error) {
  const auto index = folder.index();
  if (!index.empty()) pack_study(folder.path(), pack_error);
  const std::vector<CaseStatus> states = folder.status(cases, index);
  const auto others = std::count_if(states.begin(), states.end(), [](const CaseStatus& status) {
    return status.state == CaseState::running;
  });
  if (others > 0)
    std::cerr << "cleft run: " << others << " of " << cases.size()
              << " cases are being run by another process, which packs them at its end; cleft status "
              << folder.path() << " shows when they are published\n";
}

Json figures_of(const RunReport& r) {
  return {{"cases", r.cases},         {"already_published", r.already_published},
          {"published", r.published}, {"superseded", r.superseded},
          {"failed", r.failed},       {"interrupted", r.interrupted}};
}

/// Options of the command line override those of the study file.
SlurmSettings over(SlurmSettings settings, const SlurmSettings& said) {
  if (!said.partition.empty()) settings.partition = said.partition;
  if (!said.account.empty()) settings.account = said.account;
  if (!said.time.empty()) settings.time = said.time;
  if (said.cases_per_task > 0) settings.cases_per_task = said.cases_per_task;
  for (const std::string& option : said.options) check_sbatch_option(option, "--sbatch");
  settings.options.insert(settings.options.end(), said.options.begin(), said.options.end());
  return settings;
}

}  // namespace

int main(int argc, char** argv) {
  CommandLine app("Runs every case of a study and publishes it. Run again, it finishes what is missing.",
                  "cleft run");
  std::string file, out, launcher = "local";
  LocalOptions options;
  options.jobs = 0;
  bool dry_run = false, json = false;
  std::string memory;
  SlurmSettings slurm;
  std::string task;
  app.add_option("STUDY.toml", file, "study file")->required();
  app.add_option("--out", out, "study folder")->required();
  app.add_option("--jobs", options.jobs, "cases at a time (default: as many as there are cores)")
      ->check(in_range(1, 4096));
  app.add_option("--ranks", options.ranks, "MPI ranks of each solve")
      ->check(in_range(1, 4096))
      ->capture_default_str();
  app.add_option(
         "--threads", options.threads,
         "threads of each process; a study's numbers are the same, bit for bit, for equal ranks and threads")
      ->check(in_range(1, 4096))
      ->capture_default_str();
  app.add_option("--memory", memory,
                 "GB that cases may take together, as estimated, as 4, 4GB or 500MB (default: nine tenths of "
                 "what is free)");
  app.add_option("--launcher", launcher, "where cases run")
      ->check(one_of({"local", "slurm"}))
      ->capture_default_str();
  app.add_option("--partition", slurm.partition, "Slurm: partition");
  app.add_option("--account", slurm.account, "Slurm: account");
  app.add_option("--time", slurm.time, "Slurm: time limit of a task, as sbatch takes it");
  app.add_option("--sbatch", slurm.options,
                 "Slurm: a further option of sbatch, --sbatch=--mem=4G (repeatable)")
      ->allow_extra_args(false);
  app.add_option("--cases-per-task", slurm.cases_per_task,
                 "Slurm: cases in a task of the array (default: 32)")
      ->check(in_range(1, 10000));
  app.add_option("--task", task, "")->group("");  // what a task of the array is called with
  app.add_flag("--retry-failed", options.retry_failed, "run cases again that have failed before");
  app.add_flag("--dry-run", dry_run,
               "print the cases, their state, and what they will take by those measured; run nothing");
  app.add_flag("--json", json, "print the figures as JSON");

  return run_command(app, argc, argv, [&] {
    const Study study = read_study(file);
    if (options.jobs == 0)
      options.jobs = std::max(
          1, static_cast<int>(std::thread::hardware_concurrency()) / (options.ranks * options.threads));
    if (dry_run) return list_cases(study, known_cases(study, out), out, options.jobs, json);
    cases_of(study);  // mistakes are told before a folder is made
    options.memory = memory_to_use(memory, "--memory");
    const StudyFolder folder = task.empty() ? StudyFolder::create(out, study) : StudyFolder(out);
    if (task.empty())
      for (const auto& [hash, why, aside] : folder.set_damaged_aside())
        std::cerr << "cleft run: warning: case " << hash << ": " << why
                  << "; it is made again, and what is left of it is in " << aside << "\n";
    const auto run = [&](const std::vector<Case>& cases) {
      return !task.empty()         ? run_slurm_task(folder, study, cases, options, task)
             : launcher == "slurm" ? run_slurm(folder, study, cases, options, over(study.slurm, slurm))
                                   : run_local(folder, study, cases, options);
    };
    const bool adapts = task.empty() && study.sampling.adapts;
    RunReport report;
    Decision decision{Choice::added, std::nan("")};
    do {
      const std::vector<Case> cases = cases_of(study, folder);
      const RunReport last = run(cases);
      report = report.cases == 0 ? last : with_batch(report, last);
      if (task.empty() && report.interrupted == 0) pack_published(folder, cases, study.pack_error);
      if (!adapts || report.interrupted > 0) break;
      decision = choose_more(folder, study);
      tell(decision, study, report.cases);
    } while (decision.choice == Choice::added);
    print_figures(figures_of(report), json);
    if (report.failed > 0)
      throw std::runtime_error(std::to_string(report.failed) + " of " + std::to_string(report.cases) +
                               " cases failed; cleft status " + out + " says why");
    if (report.interrupted > 0) throw std::runtime_error("interrupted; run the same command again to finish");
  });
}
