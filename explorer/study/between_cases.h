// The fields between a study's cases. Their data are read once, on a thread of its own.
#pragma once

#include <atomic>
#include <functional>
#include <future>
#include <map>
#include <memory>
#include <string>

#include "encoder/field/field.h"

namespace cleft {

class StudyInterpolator;

class BetweenCases {
 public:
  /// Begins to read the study (a folder or a study.dffd) on a thread of its own: 3 s for 200 cases, about a
  /// MB each. Destruction of this object stops the thread at the next case.
  explicit BetweenCases(const std::string& study);
  ~BetweenCases();

  bool ready() const;
  /// Waits for the thread, and calls `go_on` with the completed part, 0 to 1; an exception of `go_on` ends
  /// the waiting.
  void wait(const std::function<void(double part)>& go_on) const;
  double part_done() const { return part_; }
  /// The field for these parameters; waits for the thread, then takes milliseconds. Its `interpolation` holds
  /// the estimated error. Throws InputError if the study cannot be interpolated.
  std::shared_ptr<const Field> at(const std::map<std::string, double>& parameters) const;

 private:
  std::atomic<double> part_ = 0;
  std::atomic<bool> unwanted_ = false;
  std::shared_future<std::shared_ptr<const StudyInterpolator>>
      prepared_;  // its destruction waits for the thread
};

}  // namespace cleft
