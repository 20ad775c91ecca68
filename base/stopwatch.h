// Seconds of a steady clock.
#pragma once

#include <algorithm>
#include <chrono>
#include <limits>

namespace cleft {

class Stopwatch {
 public:
  /// Since the watch was made.
  double seconds() const { return between(start_, Clock::now()); }
  /// Since the last lap; since the watch was made for the first.
  double lap() {
    const auto now = Clock::now();
    const double seconds = between(last_, now);
    last_ = now;
    return seconds;
  }

 private:
  using Clock = std::chrono::steady_clock;
  static double between(Clock::time_point from, Clock::time_point to) {
    return std::chrono::duration<double>(to - from).count();
  }
  Clock::time_point start_ = Clock::now(), last_ = start_;
};

/// Seconds that `work` takes, the least of `repeats` times: what else the machine does is left out.
template <class Work>
double least_seconds(int repeats, const Work& work) {
  double least = std::numeric_limits<double>::infinity();
  for (int repeat = 0; repeat < repeats; ++repeat) {
    const Stopwatch watch;
    work();
    least = std::min(least, watch.seconds());
  }
  return least;
}

}  // namespace cleft
