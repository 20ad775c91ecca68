// Clocks, absolute sleeps, and what a thread asks of the system before it keeps time.
#pragma once

#include <sched.h>
#include <time.h>

#include <algorithm>
#include <cstdint>
#include <string>

namespace cleft {

inline constexpr std::int64_t clock_second = 1000000000;

/// ns; of CLOCK_MONOTONIC without a system call.
std::int64_t clock_time(clockid_t clock);

/// Until CLOCK_MONOTONIC's `time`, ns.
void sleep_until(std::int64_t time);
/// The same, for ticks: the last 60 us are waited through awake, so that what waking up brings with it (the
/// scheduler's and timers' own work, a slow clock of the processor) is over when the time comes.
void be_awake_at(std::int64_t time);

/// Does `step` at once and then each `period`, ns, until `over`. One that is late is made up for by going on
/// sooner, but by one period at most.
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

/// As long as it lives, sleeps of the thread that made it end as exactly as the system can, with `real_time`
/// under SCHED_FIFO. The thread's stack and the program's code are touched, so that no tick waits for them;
/// with `real_time` the program's memory is locked, and stays so.
class TickingThread {
 public:
  explicit TickingThread(bool real_time);
  ~TickingThread();
  TickingThread(const TickingThread&) = delete;
  TickingThread& operator=(const TickingThread&) = delete;

  const std::string& refused() const { return refused_; }  ///< "" where nothing was

 private:
  int slack_, policy_;
  sched_param priority_{};
  std::string refused_;
};

}  // namespace cleft
