// study.dffd, while cases are published and when a run ends.
#pragma once

#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

#include "base/process.h"
#include "base/stopwatch.h"

namespace cleft {

/// Packs the published fields of a study into its study.dffd (cleft pack), after any other run of the study
/// that does so just now. What is to be said of it goes to stderr. Throws std::runtime_error where it fails;
/// the earlier file is then as it was, as it is where a signal ends this process.
void pack_study(const std::string& study);

/// Keeps study.dffd up to date while a run goes on: each time the whole file anew, and only where the last
/// packing, by whatever run of the study, is twenty times as long ago as it took. So all packing takes a
/// twentieth of a core's time at most, and the file is behind by some seconds, of thousands of cases by
/// minutes.
class Packing {
 public:
  /// `stop`: of the run; it ends what is under way too.
  Packing(std::string study, const StopCount& stop);
  ~Packing();
  Packing(const Packing&) = delete;
  Packing& operator=(const Packing&) = delete;

  /// There are cases that the file may lack. To be called by any thread.
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
