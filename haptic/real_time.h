// Clocks, absolute sleeps, and the system settings of a thread that keeps time.
#pragma once

#include <sched.h>
#include <time.h>

#include <algorithm>
#include <cstdint>
#include <string>

namespace cleft {

inline constexpr std::int64_t clock_second = 1000000000;

/// The time of a clock, ns; for CLOCK_MONOTONIC without a system call.
std::int64_t clock_time(clockid_t clock);

/// Sleeps until `time` of CLOCK_MONOTONIC, ns.
void sleep_until(std::int64_t time);
/// The same for ticks: the thread wakes 60 us earlier and waits actively, so that the effects of waking up
/// (work of scheduler and timers, a slow processor clock) are over at the given time.
void be_awake_at(std::int64_t time);

/// Calls `step` at once and then each `period`, ns, until `over` is true. A late step is compensated by an
/// earlier next one, by one period at most.
template <class Over, class Step>
void repeat(std::int64_t period, const Over& over, const Step& step) {
  for (std::int64_t due = clock_time(CLOCK_MONOTONIC); !over();
       due = std::max(due, clock_time(CLOCK_MONOTONIC) - period)) {
    step();
    sleep_until(due += period);
  }
}

/// Page faults of this thread so far.
std::int64_t page_faults();

/// During its lifetime sleeps of the constructing thread end as precisely as the system permits, with
/// `real_time` under SCHED_FIFO. The thread's stack and the program's code are touched, so that no tick waits
/// for them; with `real_time` the memory of the program is locked, also afterwards.
class TickingThread {
 public:
  explicit TickingThread(bool real_time);
  ~TickingThread();
  TickingThread(const TickingThread&) = delete;
  TickingThread& operator=(const TickingThread&) = delete;

  const std::string& refused() const { return refused_; }  ///< "" if nothing was refused

 private:
  int slack_, policy_;
  sched_param priority_{};
  std::string refused_;
};

}  // namespace cleft
