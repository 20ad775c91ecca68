#include "params/run/slurm.h"

#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <random>
#include <set>
#include <sstream>

#include "base/error.h"
#include "base/output_file.h"
#include "base/process.h"
#include "base/sealed_json.h"
#include "base/text.h"
#include "base/unfinished.h"
#include "params/run/lock.h"
#include "params/run/packing.h"
#include "params/run/signal_handler.h"
#include "params/run/slurm_task.h"
#include "params/run/solve_groups.h"

namespace cleft {

namespace fs = std::filesystem;

namespace {

constexpr int most_submissions = 3;       // of a case, by one run
constexpr int usual_cases_per_task = 32;  // a task takes Slurm a tenth of a second
constexpr int seconds_before_limit = 60;  // in which a task stops and requests to be queued again
constexpr double shortest_poll = 0.5, longest_poll = 10;

volatile std::sig_atomic_t leave = 0;

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::string new_name() {
  std::random_device random;
  std::string name = "cleft-";
  for (int i = 0; i < 10; ++i) name += "0123456789abcdef"[random() % 16];
  return name;
}

/// In single quotes, for the shell.
std::string quoted(const std::string& word) {
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

/// sbatch replaces %j and the like in the names of logs; %% stands for the character itself.
std::string without_patterns(const std::string& path) {
  std::string text;
  for (const char c : path) text += c == '%' ? std::string("%%") : std::string(1, c);
  return text;
}

/// Tasks of whole groups of one stiffness, with as many cases in each as requested, or slightly fewer.
SlurmTasks tasks_of(const std::vector<Case>& cases, int cases_per_task) {
  SlurmTasks tasks;
  const std::size_t most = cases_per_task;
  for (const auto& group : solve_groups(cases, 1, most)) {
    if (tasks.empty() || tasks.back().size() + group.size() > most) tasks.emplace_back();
    for (const std::size_t member : group) tasks.back().push_back(cases[member].hash());
  }
  return tasks;
}

class SlurmRun {
 public:
  SlurmRun(const StudyFolder& folder, const std::vector<Case>& cases, const LocalOptions& options,
           SlurmSettings settings)
      : folder_(folder),
        cases_(cases),
        options_(options),
        settings_(std::move(settings)),
        place_(fs::absolute(folder.path()).string() + "/slurm"),
        packing_(folder.path(), leave) {
    make_shared_folder(folder.path(), "slurm");
    for (const Case& one : cases) hashes_.push_back(one.hash());
  }

  RunReport run() {
    report_.cases = static_cast<int>(cases_.size());
    bool first = true;
    for (double poll = shortest_poll; !leave; poll = std::min(longest_poll, 1.3 * poll)) {
      const std::optional<std::set<std::string>> queued = cases_in_queue();
      tell_what_happened(first);
      if (queued) {
        const std::vector<Case> missing = missing_cases(*queued, first);
        if (!missing.empty()) submit(missing), poll = shortest_poll;
        if (missing.empty() && queued->empty()) break;
        first = false;
      }
      usleep(static_cast<useconds_t>(1e6 * poll));
    }
    if (leave)
      std::cerr << "The jobs go on: the same command finds them again. scancel -n NAME ends them; the names "
                   "stand in "
                << place_ << ".\n";
    report_.interrupted = report_.cases - report_.already_published - report_.published - report_.failed;
    return report_;
  }

 private:
  ProcessResult slurm(const std::vector<std::string>& argv, std::string& output) const {
    const std::string base = place_ + "/." + argv.front() + "." + std::to_string(getpid());
    const Unfinished log(base + ".log"), out(base + ".out");
    const ProcessResult result = run_process(argv, base + ".log", {}, nullptr, base + ".out");
    output = read_text_file(base + ".out");
    if (!result.success()) output = read_text_file(base + ".log");
    fs::remove(base + ".log"), fs::remove(base + ".out");
    return result;
  }

  /// Hashes of the cases whose tasks wait or run; none where Slurm does not answer just now.
  std::optional<std::set<std::string>> cases_in_queue() {
    std::string output;
    const ProcessResult result =
        slurm({"squeue", "-h", "-r", "-u", std::to_string(getuid()), "-o", "%j|%K"}, output);
    if (!result.success()) {
      if (!silent_) std::cerr << "squeue does not answer; it is asked again: " << output;
      silent_ = true;
      return {};
    }
    silent_ = false;
    std::set<std::string> cases;
    for (const std::string& line : lines_of(output)) {
      const std::size_t bar = line.find('|');
      const std::string name = line.substr(0, bar), file = place_ + "/" + name + "/tasks.json";
      if (bar == std::string::npos || name.rfind("cleft-", 0) != 0 || !fs::exists(file)) continue;
      auto& tasks = tasks_[name];
      if (tasks.empty()) tasks = read_slurm_tasks(file);
      const std::size_t number = parse_number(line.substr(bar + 1), "squeue");
      if (number < tasks.size()) cases.insert(tasks[number].begin(), tasks[number].end());
    }
    return cases;
  }

  /// What has been published or has failed since the last look, a line each.
  void tell_what_happened(bool first) {
    const std::vector<CaseStatus> now = folder_.status(cases_, folder_.index());
    for (std::size_t c = 0; c < now.size(); ++c) {
      const bool had_ended = ended_.contains(c);
      if (now[c].state == CaseState::published && !had_ended) {
        ++(first ? report_.already_published : report_.published);
        ended_.insert(c);
        packing_.published();
        if (!first) say(c, "published");
      }
    }
    states_ = now;
  }

  void say(std::size_t c, const std::string& what) const {
    std::cerr << "[" << ended_.size() << "/" << cases_.size() << "] " << hashes_[c] << " " << what << "\n";
  }

  /// Those that are to be submitted now.
  std::vector<Case> missing_cases(const std::set<std::string>& queued, bool first) {
    std::vector<Case> missing;
    for (std::size_t c = 0; c < cases_.size(); ++c) {
      const CaseStatus& state = states_[c];
      if (ended_.contains(c) || queued.contains(hashes_[c]) || state.state == CaseState::running) continue;
      const bool sticks = state.state == CaseState::failed && !state.again;
      const bool retried = first && options_.retry_failed;
      if ((sticks && !retried) || submissions_[c] >= most_submissions) {
        ++report_.failed;
        ended_.insert(c);
        say(c, "failed: " + (state.reason.empty()
                                 ? std::string("its jobs ended without a word; their logs are in ") + place_
                                 : state.reason));
        continue;
      }
      ++submissions_[c];
      missing.push_back(cases_[c]);
    }
    return missing;
  }

  /// Indices of an array go from 0 to one less than the site's limit.
  std::size_t most_in_array() const {
    std::string output;
    if (slurm({"scontrol", "show", "config"}, output).success())
      for (const std::string& line : lines_of(output))
        if (line.rfind("MaxArraySize", 0) == 0)
          return std::max<std::size_t>(1, std::strtoul(line.substr(line.find('=') + 1).c_str(), nullptr, 10));
    return 1001;  // Slurm's default
  }

  void submit(const std::vector<Case>& missing) {
    const SlurmTasks tasks =
        tasks_of(missing, settings_.cases_per_task > 0 ? settings_.cases_per_task : usual_cases_per_task);
    const std::size_t most = most_in_array();
    for (std::size_t begin = 0; begin < tasks.size() && !leave; begin += most) {
      const std::size_t end = std::min(tasks.size(), begin + most);
      submit_array({tasks.begin() + static_cast<std::ptrdiff_t>(begin),
                    tasks.begin() + static_cast<std::ptrdiff_t>(end)});
    }
  }

  /// The record of an array is written before it is submitted: its name leads from the queue to its cases.
  void submit_array(const SlurmTasks& tasks) {
    const std::string name = new_name(), record = place_ + "/" + name;
    make_shared_folder(place_, name);
    write_text_file(record + "/tasks.json",
                    sealed_text({{"format", "cleft-tasks"}, {"version", 2}, {"tasks", tasks}}));
    write_text_file(record + "/job.sh", script_of(record));
    std::vector<std::string> argv = {"sbatch",
                                     "--parsable",
                                     "--job-name=" + name,
                                     "--array=0-" + std::to_string(tasks.size() - 1),
                                     "--ntasks=" + std::to_string(options_.ranks),
                                     "--cpus-per-task=" + std::to_string(options_.threads),
                                     "--output=" + without_patterns(record) + "/%a.log",
                                     "--open-mode=append",
                                     "--requeue",
                                     "--signal=B:USR1@" + std::to_string(seconds_before_limit)};
    for (const auto& [option, value] : {std::pair("--partition=", settings_.partition),
                                        {"--account=", settings_.account},
                                        {"--time=", settings_.time}})
      if (!value.empty()) argv.push_back(option + value);
    argv.insert(argv.end(), settings_.options.begin(), settings_.options.end());
    argv.push_back(record + "/job.sh");
    std::string output;
    if (!slurm(argv, output).success()) {
      if (output.find("Unable to contact") == std::string::npos)
        throw InputError(
            "sbatch refuses the jobs: " + output +
            "(partition, account, time and options: [slurm] in the study file, or the command line)");
      std::cerr << "sbatch does not reach Slurm; the jobs are submitted again: " << output;
      return;
    }
    if (output.empty()) throw std::runtime_error("sbatch named no job: is the disk of " + place_ + " full?");
    std::cerr << "submitted job " << lines_of(output).front() << ": " << tasks.size() << " tasks\n";
  }

  std::string script_of(const std::string& record) const {
    const std::string study = fs::absolute(folder_.path()).string();
    std::string text = "#!/bin/sh\n# Written by cleft run --launcher slurm.\nexec " +
                       quoted(executable_folder() + "/cleft-run") + " " + quoted(study + "/study.toml") +
                       " --out " + quoted(study) + " --task " + quoted(record + "/tasks.json") + " --ranks " +
                       std::to_string(options_.ranks) + " --threads " + std::to_string(options_.threads);
    return text + (options_.retry_failed ? " --retry-failed\n" : "\n");
  }

  const StudyFolder& folder_;
  const std::vector<Case>& cases_;
  const LocalOptions options_;
  const SlurmSettings settings_;
  const std::string place_;
  std::vector<std::string> hashes_;
  std::vector<CaseStatus> states_;
  std::map<std::string, SlurmTasks> tasks_;  // by the name of their job
  std::map<std::size_t, int> submissions_;
  std::set<std::size_t> ended_;
  bool silent_ = false;  // Slurm did not answer
  Packing packing_;
  RunReport report_;
};

}  // namespace

RunReport run_slurm(const StudyFolder& folder, const Study&, const std::vector<Case>& cases,
                    const LocalOptions& options, const SlurmSettings& settings) {
  const SignalHandler handler({SIGINT, SIGTERM}, [](int) { leave = 1; });
  return SlurmRun(folder, cases, options, settings).run();
}

}  // namespace cleft
