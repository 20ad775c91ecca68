#include "params/launcher/local.h"

#include <unistd.h>

#include <atomic>
#include <csignal>
#include <filesystem>
#include <iostream>
#include <mutex>
#include <thread>

#include "base/error.h"
#include "base/output_file.h"
#include "base/process.h"
#include "base/stopwatch.h"
#include "base/text.h"

namespace cleft {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

volatile std::sig_atomic_t stop_signal = 0;

/// A child fails its case by what it prints last; a signal to the run stops the run.
struct CaseFailure : std::runtime_error {
  using std::runtime_error::runtime_error;
};
struct Interrupted {};

std::string last_line(const std::string& log) {
  std::string text = read_text_file(log), line;
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text.substr(text.rfind('\n') + 1);
}

class LocalRun {
 public:
  LocalRun(const StudyFolder& folder, const std::vector<Case>& cases, const LocalOptions& options)
      : folder_(folder), cases_(cases), options_(options), bin_(executable_folder()) {
    solved_ = folder.solved_cases();
    const int cores = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
    environment_["OPENBLAS_NUM_THREADS"] = environment_["OMP_NUM_THREADS"] =
        std::to_string(std::max(1, cores / (options.jobs * options.ranks)));
    if (geteuid() == 0)
      environment_["OMPI_ALLOW_RUN_AS_ROOT"] = environment_["OMPI_ALLOW_RUN_AS_ROOT_CONFIRM"] = "1";
  }

  RunReport run() {
    report_.cases = static_cast<int>(cases_.size());
    std::vector<std::thread> workers;
    for (int i = 0; i < options_.jobs; ++i) workers.emplace_back([this] { work(); });
    for (std::thread& worker : workers) worker.join();
    const int ended = report_.already_published + report_.published + report_.superseded + report_.failed;
    report_.interrupted = report_.cases - ended;  // running or not yet begun when the run was stopped
    return report_;
  }

 private:
  void work() {
    for (std::size_t i; !stop_signal && (i = next_++) < cases_.size();) {
      const std::string hash = cases_[i].hash();
      try {
        run_case(cases_[i]);
      } catch (const std::exception& e) {  // a full disk, say: this case's failure, not the others'
        count(&RunReport::failed, hash, std::string("failed: ") + e.what());
      }
    }
  }

  void run_case(const Case& one) {
    const std::string hash = one.hash();
    const CaseState state = folder_.status(hash).state;
    if (state == CaseState::published) return count(&RunReport::already_published, hash, "already published");
    if (state == CaseState::running)
      return count(&RunReport::superseded, hash, "is being run by another process");
    const Attempt attempt = folder_.begin(hash);
    try {
      const Stopwatch watch;
      Json manifest = attempt_case(one, attempt);
      manifest["seconds"] = watch.seconds();
      const bool won = folder_.publish(attempt, hash, std::move(manifest),
                                       {"case.toml", "case.h5", "case.dffd", "solve.log", "encode.log"});
      if (won) {
        const std::lock_guard guard(mutex_);
        solved_[solve_hash(one.parameters)] = folder_.published(hash);
      }
      count(won ? &RunReport::published : &RunReport::superseded, hash,
            won ? "published" : "superseded: another run published it first");
    } catch (const CaseFailure& e) {
      folder_.fail(attempt, e.what());
      count(&RunReport::failed, hash, std::string("failed: ") + e.what() + " (log: " + attempt.folder + ")");
    } catch (const Interrupted&) {
      say(hash, "interrupted");
    }
  }

  Json attempt_case(const Case& one, const Attempt& attempt) {
    const std::string file = attempt.folder + "/case.toml", snapshot = attempt.folder + "/case.h5",
                      field = attempt.folder + "/case.dffd";
    write_text_file(file, case_file_text(one));
    const std::string solve_identity = solve_hash(one.parameters);
    if (!reuse(solve_identity, attempt.folder))
      child("solve", {file, "--out", snapshot, "--json"}, attempt.folder + "/solve.log");
    std::vector<std::string> encode = {snapshot, "--out", field, "--json"};
    for (const std::string& argument : one.encode.arguments()) encode.push_back(argument);
    child("encode", encode, attempt.folder + "/encode.log");
    child("check", {snapshot, field}, attempt.folder + "/check.log");
    fs::remove(attempt.folder + "/check.log");

    Json manifest = {{"format", "cleft-case"},
                     {"version", 1},
                     {"producer", producer()},
                     {"case", one.hash()},
                     {"solve", solve_identity}};
    for (const Parameter& row : parameter_table()) {
      const Value value = get_parameter(one.parameters, row);
      std::visit([&](const auto& v) { manifest["parameters"][row.name] = v; }, value);
    }
    return manifest;
  }

  /// A new [encode] does not solve again: where a published snapshot of the same solve is sound it serves
  /// again, as the same file, or as a copy where links are not possible.
  bool reuse(const std::string& solve_identity, const std::string& attempt) {
    std::string published;
    {
      const std::lock_guard guard(mutex_);
      const auto found = solved_.find(solve_identity);
      if (found == solved_.end()) return false;
      published = found->second;
    }
    const ProcessResult check = run_process({bin_ + "/cleft-check", published + "/case.h5"},
                                            attempt + "/check.log", environment_, &stop_signal);
    if (!check.success()) return false;
    for (const char* name : {"/case.h5", "/solve.log"}) {
      std::error_code error;
      fs::create_hard_link(published + name, attempt + name, error);
      if (error) fs::copy_file(published + name, attempt + name);
    }
    return true;
  }

  void child(const std::string& command, const std::vector<std::string>& arguments,
             const std::string& log) const {
    std::vector<std::string> argv;
    if (command == "solve" && options_.ranks > 1)
      argv = {"mpirun", "--bind-to", "none", "--oversubscribe", "-n", std::to_string(options_.ranks)};
    argv.push_back(bin_ + "/cleft-" + command);
    argv.insert(argv.end(), arguments.begin(), arguments.end());
    const ProcessResult result = run_process(argv, log, environment_, &stop_signal);
    if (stop_signal) throw Interrupted();
    if (result.success()) return;
    if (result.signal) throw CaseFailure(command + " was ended by signal " + std::to_string(result.signal));
    throw CaseFailure(command + " ended with exit code " + std::to_string(result.exit_code) + ": " +
                      last_line(log));
  }

  void count(int RunReport::*counter, const std::string& hash, const std::string& what) {
    {
      const std::lock_guard guard(mutex_);
      ++(report_.*counter);
    }
    say(hash, what);
  }

  void say(const std::string& hash, const std::string& what) {
    const std::lock_guard guard(mutex_);
    std::cerr << "[" << ++done_ << "/" << cases_.size() << "] " << hash << " " << what << "\n";
  }

  const StudyFolder& folder_;
  const std::vector<Case>& cases_;
  const LocalOptions options_;
  const std::string bin_;
  std::map<std::string, std::string> environment_;
  std::atomic<std::size_t> next_ = 0;
  std::mutex mutex_;
  std::size_t done_ = 0;
  RunReport report_;
  std::map<std::string, std::string> solved_;  // published folders by what their solver saw
};

}  // namespace

RunReport run_local(const StudyFolder& folder, const std::vector<Case>& cases, const LocalOptions& options) {
  struct sigaction action = {};
  action.sa_handler = [](int) { stop_signal = stop_signal + 1; };
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  return LocalRun(folder, cases, options).run();
}

}  // namespace cleft
