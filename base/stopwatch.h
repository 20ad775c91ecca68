// Seconds of a steady clock.
#pragma once

#include <algorithm>
#include <chrono>
#include <ctime>
#include <limits>

namespace cleft {

class Stopwatch {
 public:
  /// Seconds since construction.
  double seconds() const { return between(start_, Clock::now()); }
  /// Seconds since the last lap, or since construction.
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

/// Seconds of processor time of this process so far.
inline double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// The shortest time of `repeats` runs of `work`, s, which excludes other load of the machine.
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
