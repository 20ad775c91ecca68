// Compute times and lateness of ticks.
#pragma once

#include <array>
#include <cstdint>

namespace cleft {

/// Times in seconds, counted in steps of a sixteenth of an octave from 1 ns on: quantiles are accurate to 4.4
/// %.
class TimeHistogram {
 public:
  void add(double seconds);
  std::uint64_t count() const { return count_; }
  double quantile(double part) const;  ///< s, the upper end of its step; 0 if nothing was counted
  double largest() const { return largest_; }

 private:
  static constexpr int steps = 16, octaves = 34;
  std::array<std::uint64_t, steps * octaves> counts_{};
  std::uint64_t count_ = 0;
  double largest_ = 0;
};

struct LoopStatistics {
  TimeHistogram compute;                  ///< of a tick, by the thread's own CPU clock
  TimeHistogram lateness;                 ///< of waking up
  std::uint64_t ticks = 0, overruns = 0;  ///< an overrun: a tick that ended after the next one's time
  std::array<std::uint64_t, 256> overrun_ticks{};  ///< the first ones
  std::uint64_t missed = 0;                        ///< ticks that there were not, because of overruns
  std::int64_t page_faults = 0;                    ///< of the thread, in the loop
  double largest_force = 0, largest_change = 0;    ///< N; N for each tick
  /// Largest change a tick beyond the permitted one, change * force + floor: N, 0 if none exceeded it.
  double excess_change = 0;
};

}  // namespace cleft
