// The fields between a study's cases: what they are interpolated from is read once, beside all else.
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
  /// MB each. The end of this object ends that, at the next case.
  explicit BetweenCases(const std::string& study);
  ~BetweenCases();

  bool ready() const;
  /// Waits for that as long as `go_on`, called with the part that is done, does not throw.
  void wait(const std::function<void(double part)>& go_on) const;
  double part_done() const { return part_; }
  /// The field of these parameters, in milliseconds once all is ready, which it waits for. Its
  /// `interpolation` tells the estimated error. Throws InputError where the study's cases have none.
  std::shared_ptr<const Field> at(const std::map<std::string, double>& parameters) const;

 private:
  std::atomic<double> part_ = 0;
  std::atomic<bool> unwanted_ = false;
  std::shared_future<std::shared_ptr<const StudyInterpolator>> prepared_;  // its end waits for the thread
};

}  // namespace cleft
