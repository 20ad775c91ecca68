// Writes study.dffd during a run and at its end.
#pragma once

#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

#include "base/process.h"
#include "base/stopwatch.h"

namespace cleft {

/// Packs the published fields of a study into its study.dffd (cleft pack), after any other run of the study
/// that is packing; with --modes `error`, if that is not 0. Messages go to stderr. Throws std::runtime_error
/// if it fails; the earlier file is then unchanged, also if a signal ends this process.
void pack_study(const std::string& study, double error = 0);

/// Keeps study.dffd up to date during a run: rewrites the file if the time since the last packing, by any run
/// of the study, is twenty times what that took. Packing thus takes at most a twentieth of a core, and the
/// file is late by some seconds, for thousands of cases by minutes.
class Packing {
 public:
  /// `stop`: that of the run; it also ends a packing in progress.
  Packing(std::string study, const StopCount& stop);
  ~Packing();
  Packing(const Packing&) = delete;
  Packing& operator=(const Packing&) = delete;

  /// Announces cases that the file may lack. May be called by any thread.
  void published();

 private:
  void keep_up();
  bool is_due() const;

  const std::string study_;
  const Stopwatch watch_;
  const StopCount& stop_;
  bool ended_ = false, behind_ = false;
  std::mutex mutex_;
  std::condition_variable end_;
  std::thread thread_;
};

}  // namespace cleft
