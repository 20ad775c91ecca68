#include "params/run/local.h"

#include <algorithm>
#include <condition_variable>
#include <csignal>
#include <deque>
#include <filesystem>
#include <memory>
#include <mutex>
#include <thread>

#include "base/error.h"
#include "base/stopwatch.h"
#include "base/text.h"
#include "params/run/case_work.h"
#include "params/run/estimates.h"
#include "params/run/packing.h"
#include "params/run/run_table.h"
#include "params/run/signal_handler.h"
#include "params/run/solve_groups.h"
#include "params/stiffness.h"

namespace cleft {

namespace {

StopCount stop_count = 0, stop_signal = 0;

constexpr std::size_t check_together = 8;  // cases
constexpr std::size_t encode_together = 32;
constexpr double longest_wait = 5;  // seconds of an encoded case for others to be checked with

using CasePointer = std::unique_ptr<CaseOnItsWay>;

CaseWork::Settings settings_of(const LocalOptions& options) {
  CaseWork::Settings settings{options.ranks, options.threads, options.mpi_launcher};
  if (settings.mpi_launcher.empty() && options.ranks > 1)
    settings.mpi_launcher = {"mpirun",          "--bind-to", "none",
                             "--oversubscribe", "-n",        std::to_string(options.ranks)};
  return settings;
}

/// Workers take what is nearest to being published: cases to check, then cases to encode, then groups to
/// solve.
class LocalRun {
 public:
  LocalRun(const StudyFolder& folder, const Study& study, const std::vector<Case>& cases,
           const LocalOptions& options)
      : folder_(folder),
        cases_(cases),
        options_(options),
        work_(folder, study, settings_of(options), stop_count),
        packing_(folder.path(), stop_count) {
    const auto published = folder.index();
    estimates_ = Estimates(published);
    for (const auto& [hash, one] : published)
      if (one.snapshot) solved_[one.solve] = hash;
    report_.cases = static_cast<int>(cases.size());
    std::vector<Case> missing;
    std::vector<std::size_t> numbers;
    const std::vector<CaseStatus> states = folder.status(cases, published);
    for (std::size_t c = 0; c < cases.size(); ++c) {
      const CaseStatus& state = states[c];
      if (state.state == CaseState::published)
        ++report_.already_published;
      else if (state.state == CaseState::failed && !state.again && !options.retry_failed)
        not_retried(c, state.reason);
      else
        missing.push_back(cases[c]), numbers.push_back(c);
    }
    for (std::vector<std::size_t> group : solve_groups(missing, options.jobs)) {
      for (std::size_t& member : group) member = numbers[member], unfinished_work_ += seconds_of(member);
      groups_.push_back(std::move(group));
    }
  }

  RunReport run() {
    RunTable table([this] { return rows(); });
    table_ = &table;
    for (const std::string& line : early_lines_) table.say(line);
    if (report_.already_published > 0)
      table.say(std::to_string(report_.already_published) + " of " + std::to_string(report_.cases) +
                " cases are already published");
    std::vector<std::thread> workers;
    for (int i = 0; i < options_.jobs; ++i) workers.emplace_back([this] { work(); });
    for (std::thread& worker : workers) worker.join();
    table_ = nullptr;
    for (auto* queue : {&to_encode_, &to_check_})
      for (const CasePointer& one : *queue) folder_.abandon(one->attempt);
    report_.interrupted = report_.cases - ended();  // running or not yet begun when the run was stopped
    report_.stopped_by = stop_signal;
    return report_;
  }

 private:
  struct Task {
    enum { solve, encode, check, none } kind = none;
    std::vector<std::size_t> group = {};
    std::vector<CasePointer> cases = {};
    double memory = 0;
    Stopwatch watch = {};
  };

  int ended() const {
    return report_.already_published + report_.published + report_.superseded + report_.failed;
  }

  void work() {
    for (Task task = next_task(); task.kind != Task::none; task = next_task()) {
      {
        const std::lock_guard guard(mutex_);
        running_.push_back(&task);
      }
      try {
        if (task.kind == Task::solve) begin_and_solve(task);
        if (task.kind == Task::encode) encode(task);
        if (task.kind == Task::check) check_and_publish(task);
      } catch (const Interrupted&) {
        for (const CasePointer& one : task.cases)
          if (one) folder_.abandon(one->attempt);
      } catch (const std::exception& e) {  // such as a full disk: these cases fail, others do not
        for (const CasePointer& one : task.cases)
          if (one) fail(*one, {e.what(), true});
      }
      const std::lock_guard guard(mutex_);
      task.cases.clear();
      --active_;
      running_.erase(std::find(running_.begin(), running_.end(), &task));
      memory_ -= task.memory;
      changed_.notify_all();
    }
    changed_.notify_all();
  }

  /// Waits for something to do; none where all is done, or the run is to stop.
  Task next_task() {
    std::unique_lock guard(mutex_);
    Task task;
    while (!stop_count && !may_take(task) && !is_done())
      changed_.wait_for(guard, std::chrono::milliseconds(100));
    if (task.kind == Task::none) return task;
    ++active_;
    memory_ += task.memory;
    return task;
  }

  bool is_done() const { return active_ == 0 && to_check_.empty() && to_encode_.empty() && groups_.empty(); }

  bool may_take(Task& task) {
    const auto fits = [&](double memory) {
      task.memory = memory;
      return active_ == 0 || memory_ + memory <= options_.memory;
    };
    const auto size = [&](std::size_t number) { return size_of(cases_[number].parameters); };
    const bool nobody_to_wait_for = to_encode_.empty() || oldest_to_check_.seconds() > longest_wait;
    if (to_check_.size() >= check_together || (!to_check_.empty() && nobody_to_wait_for)) {
      take_checks(task);
    } else if (!to_encode_.empty()) {
      if (!fits(estimates_.encoder_memory(size(to_encode_.front()->number)))) return false;
      take_to_encode(task);
    } else if (!groups_.empty()) {
      if (!fits(estimates_.solver_memory(size(groups_.front().front())))) return false;
      task.kind = Task::solve;
      task.group = std::move(groups_.front());
      groups_.pop_front();
    }
    return task.kind != Task::none;
  }

  /// The next case, and those after it that are small too, or have its mesh, and so the matrices of its fit;
  /// as far as other workers have as many, or have cases to solve.
  void take_to_encode(Task& task) {
    task.kind = Task::encode;
    const auto may_be_with_first = [&](const CaseOnItsWay& one) {
      const Case& first = *task.cases.front()->one;
      return one.one->encode.arguments() == first.encode.arguments() &&
             ((is_small(first) && is_small(*one.one)) ||
              stiffness_key(first.parameters) == stiffness_key(one.one->parameters));
    };
    const std::size_t workers = static_cast<std::size_t>(options_.jobs),
                      share =
                          groups_.empty() ? (to_encode_.size() + workers - 1) / workers : to_encode_.size(),
                      most = std::min(encode_together, share);
    do {
      task.cases.push_back(std::move(to_encode_.front()));
      to_encode_.pop_front();
    } while (task.cases.size() < most && may_be_with_first(*to_encode_.front()));
  }

  void take_checks(Task& task) {
    task.kind = Task::check;
    while (!to_check_.empty() && task.cases.size() < check_together) {
      task.cases.push_back(std::move(to_check_.front()));
      to_check_.pop_front();
    }
    oldest_to_check_ = Stopwatch();
  }

  void begin_and_solve(Task& task) {
    for (const std::size_t number : task.group) begin(task, number);
    std::vector<CaseOnItsWay*> to_solve;
    for (const CasePointer& one : task.cases)
      if (!reuse(*one)) to_solve.push_back(one.get());
    if (!to_solve.empty()) work_.solve(to_solve);
    if (to_solve.size() > 1) solve_singly(to_solve);
    for (CasePointer& one : task.cases) {
      if (one->failure) {
        fail(*one, *one->failure);
        continue;
      }
      const std::lock_guard guard(mutex_);
      to_encode_.push_back(std::move(one));
    }
  }

  /// A process that ended over one case has not solved the others.
  void solve_singly(const std::vector<CaseOnItsWay*>& cases) {
    for (CaseOnItsWay* one : cases) {
      if (!one->failure || !one->failure->again) continue;
      one->failure.reset();
      work_.solve({one});
    }
  }

  void begin(Task& task, std::size_t number) {
    const std::string hash = cases_[number].hash();
    try {
      CaseStatus state;
      auto attempt = folder_.begin(
          hash, options_.retry_failed ? StudyFolder::Retry::failed : StudyFolder::Retry::never, state);
      if (attempt) {
        const std::lock_guard guard(mutex_);
        task.cases.push_back(
            std::make_unique<CaseOnItsWay>(CaseOnItsWay{number, &cases_[number], hash, std::move(*attempt)}));
      } else if (state.state == CaseState::published) {
        count(&RunReport::already_published, number, "published by another run");
      } else {
        count(&RunReport::superseded, number, "is being run by another process");
      }
    } catch (const std::exception& e) {
      count(&RunReport::failed, number, std::string("failed: ") + e.what());
    }
  }

  bool reuse(CaseOnItsWay& one) {
    std::string published;
    {
      const std::lock_guard guard(mutex_);
      const auto found = solved_.find(one.one->snapshot_hash());
      if (found == solved_.end()) return false;
      published = folder_.published(found->second);
    }
    return work_.reuse(one, published);
  }

  void encode(Task& task) {
    std::vector<CaseOnItsWay*> cases;
    for (const CasePointer& one : task.cases) cases.push_back(one.get());
    work_.encode(cases);
    for (CasePointer& one : task.cases) {
      if (one->failure) {
        fail(*one, *one->failure);
        continue;
      }
      const std::lock_guard guard(mutex_);
      if (to_check_.empty()) oldest_to_check_ = Stopwatch();
      to_check_.push_back(std::move(one));
    }
  }

  void check_and_publish(Task& task) {
    std::vector<CaseOnItsWay*> cases;
    for (const CasePointer& one : task.cases) cases.push_back(one.get());
    work_.check(cases);
    for (CasePointer& one : task.cases) {
      if (one->failure) {
        fail(*one, *one->failure);
      } else if (work_.publish(*one)) {
        count(&RunReport::published, one->number, "published, " + as_clock(one->seconds));
        packing_.published();
      } else {
        count(&RunReport::superseded, one->number, "superseded: another run published it first");
      }
      const std::lock_guard guard(mutex_);
      one.reset();
    }
  }

  void fail(const CaseOnItsWay& one, const Failure& failure) {
    std::string where = " (log: " + one.attempt.folder + ")";
    try {
      folder_.fail(one.attempt, failure.reason, failure.again);
    } catch (const std::exception&) {  // if nothing can be written, it is reported here only
      where.clear();
    }
    count(&RunReport::failed, one.number, "failed: " + failure.reason + where);
  }

  void not_retried(std::size_t number, const std::string& reason) {
    ++report_.failed;
    early_lines_.push_back(cases_[number].hash() + " failed before: " + reason +
                           " (--retry-failed tries it again)");
  }

  void count(int RunReport::*counter, std::size_t number, const std::string& what) {
    std::string line;
    {
      const std::lock_guard guard(mutex_);
      ++(report_.*counter);
      unfinished_work_ -= seconds_of(number);
      finished_work_ += seconds_of(number);
      line = "[" + std::to_string(ended()) + "/" + std::to_string(cases_.size()) + "] " +
             cases_[number].hash() + " " + what;
    }
    table_->say(line);
  }

  /// By which cases are weighed against each other; seconds where some have been measured.
  double seconds_of(std::size_t number) const {
    const CaseSize size = size_of(cases_[number].parameters);
    return estimates_.seconds(size).value_or(size.nodes);
  }

  std::vector<std::string> rows() {
    const std::lock_guard guard(mutex_);
    std::vector<std::string> lines;
    for (const Task* task : running_) {
      const char* names[] = {"solving", "encoding", "checking"};
      std::string line = "  " + std::string(names[task->kind]);
      if (!task->cases.empty() && task->cases.front()) {
        line += " " + task->cases.front()->hash;
        if (task->cases.size() > 1) line += " and " + std::to_string(task->cases.size() - 1) + " more";
        line += progress_of(*task->cases.front());
      }
      lines.push_back(line + "  " + as_clock(task->watch.seconds()));
    }
    std::string summary = std::to_string(report_.already_published + report_.published) + " of " +
                          std::to_string(cases_.size()) + " published";
    if (report_.failed > 0) summary += ", " + std::to_string(report_.failed) + " failed";
    if (finished_work_ > 0 && unfinished_work_ > 0)
      summary += ", " + as_clock(watch_.seconds() * unfinished_work_ / finished_work_) + " left";
    else if (const auto seconds = estimates_.seconds({1, 1}); seconds && unfinished_work_ > 0)
      summary += ", " + as_clock(unfinished_work_ / options_.jobs) + " left";
    lines.push_back(summary);
    return lines;
  }

  static std::string progress_of(const CaseOnItsWay& one) {
    try {
      std::string state = read_text_file(one.file("progress"));
      while (!state.empty() && state.back() == '\n') state.pop_back();
      return ": " + state;
    } catch (const std::exception&) {
      return "";
    }
  }

  const StudyFolder& folder_;
  const std::vector<Case>& cases_;
  const LocalOptions options_;
  const CaseWork work_;
  Packing packing_;
  Estimates estimates_;
  std::map<std::string, std::string> solved_;  // published hashes by what their solver saw
  std::vector<std::string> early_lines_;
  RunTable* table_ = nullptr;
  Stopwatch watch_;

  std::mutex mutex_;  // of all below
  std::condition_variable changed_;
  std::deque<std::vector<std::size_t>> groups_;
  std::deque<CasePointer> to_encode_, to_check_;
  Stopwatch oldest_to_check_;
  std::vector<const Task*> running_;
  int active_ = 0;     // tasks
  double memory_ = 0;  // of what runs, as estimated
  double unfinished_work_ = 0, finished_work_ = 0;
  RunReport report_;
};

}  // namespace

RunReport run_local(const StudyFolder& folder, const Study& study, const std::vector<Case>& cases,
                    const LocalOptions& options) {
  const SignalHandler handler({SIGINT, SIGTERM, SIGUSR1}, [](int number) {
    stop_count = stop_count + 1;
    stop_signal = number;
  });
  folder.remove_abandoned();
  return LocalRun(folder, study, cases, options).run();
}

}  // namespace cleft
