#include "params/run/packing.h"

#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <iostream>

#include "base/error.h"
#include "base/text.h"
#include "params/run/leftovers.h"
#include "params/run/lock.h"

namespace cleft {

namespace fs = std::filesystem;

namespace {

constexpr double least_gap = 2;              // seconds between packings, and before the first
constexpr double share = 0.05;               // of the time, at most
constexpr const char* pack_lock = "/.pack";  // locked while one packs; holds the seconds that it took

/// Called by the holder of the lock. The messages of cleft pack are in `log` at its end.
bool pack(const std::string& study, const std::string& log, const StopCount* stop, double error = 0) {
  const Stopwatch watch;
  sweep_leftovers(study);
  sweep_pack_logs(study, log);
  std::vector<std::string> command = {executable_folder() + "/cleft-pack", study};
  if (error > 0) command.insert(command.end(), {"--modes", shortest(error)});
  const bool done = run_process(command, log, {}, stop, "/dev/null").success();
  if (done) std::ofstream(study + pack_lock) << watch.seconds() << "\n";
  return done;
}

std::string log_of(const std::string& study) { return study + "/.pack." + std::to_string(getpid()) + ".log"; }

}  // namespace

void pack_study(const std::string& study, double error) {
  const Moment moment(study, pack_lock);
  const std::string log = log_of(study);
  if (!pack(study, log, nullptr, error)) {
    // A log that another user has left may be replaced, though not written.
    std::string kept = study + "/pack.log";
    std::error_code immovable;
    fs::rename(log, kept, immovable);
    if (immovable) kept = log;
    throw std::runtime_error("the study's fields could not be packed into " + study + "/study.dffd; " + kept +
                             " says why");
  }
  std::cerr << read_text_file(log);
  fs::remove(log);
}

Packing::Packing(std::string study, const StopCount& stop) : study_(std::move(study)), stop_(stop) {
  // Signals are for the run's own threads, which they may wake.
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_BLOCK, &all, &before);
  thread_ = std::thread([this] { keep_up(); });
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

Packing::~Packing() {
  {
    const std::lock_guard guard(mutex_);
    ended_ = true;
  }
  end_.notify_all();
  thread_.join();
}

void Packing::published() {
  const std::lock_guard guard(mutex_);
  behind_ = true;
}

bool Packing::is_due() const {
  std::error_code none;
  const auto written = fs::last_write_time(study_ + "/study.dffd", none);
  if (none) return watch_.seconds() > least_gap;
  double took = 0;
  std::ifstream(study_ + pack_lock) >> took;
  const std::chrono::duration<double> ago = fs::file_time_type::clock::now() - written;
  return std::min(watch_.seconds(), std::abs(ago.count())) > least_gap &&
         std::abs(ago.count()) > took / share;
}

void Packing::keep_up() {
  std::unique_lock guard(mutex_);
  while (!end_.wait_for(guard, std::chrono::milliseconds(500), [this] { return ended_; })) {
    if (!behind_ || !is_due()) continue;
    behind_ = false;
    guard.unlock();
    bool done = false;
    try {
      const Lock lock(study_ + pack_lock);
      done = pack(study_, log_of(study_), &stop_);
    } catch (const std::exception&) {  // another process packs, or nothing can be written: reported at the
                                       // end of the run
    }
    std::error_code ignored;
    fs::remove(log_of(study_), ignored);
    guard.lock();
    behind_ = behind_ || !done;
  }
}

}  // namespace cleft
