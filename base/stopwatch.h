// Seconds of a steady clock.
#pragma once

#include <chrono>

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

}  // namespace cleft
