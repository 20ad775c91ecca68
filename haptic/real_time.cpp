#include "haptic/real_time.h"

#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>

#include <cerrno>
#include <cstring>

#include "haptic/bare_timer.h"

namespace cleft {

std::int64_t clock_time(clockid_t clock) {
  timespec t;
  clock_gettime(clock, &t);
  return t.tv_sec * clock_second + t.tv_nsec;
}

void sleep_until(std::int64_t time) {
  const timespec t{time / clock_second, time % clock_second};
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &t, nullptr) == EINTR) {
  }
}

std::string prepare_thread(bool real_time) {
  prctl(PR_SET_TIMERSLACK, 1UL);  // else a sleep may end 50 us late by design
  if (!real_time) return "";
  std::string refused;
  const sched_param priority{sched_get_priority_max(SCHED_FIFO) / 2};
  if (sched_setscheduler(0, SCHED_FIFO, &priority) != 0)
    refused = std::string("SCHED_FIFO: ") + std::strerror(errno);
  if (mlockall(MCL_CURRENT | MCL_FUTURE | MCL_ONFAULT) != 0)
    refused += (refused.empty() ? "" : "; ") + std::string("locked memory: ") + std::strerror(errno);
  return refused;
}

TimeHistogram bare_timer(double rate, bool real_time, const std::atomic<bool>& stop) {
  prepare_thread(real_time);
  TimeHistogram lateness;
  const auto period = static_cast<std::int64_t>(static_cast<double>(clock_second) / rate);
  for (std::int64_t due = clock_time(CLOCK_MONOTONIC); !stop;) {
    due += period;
    sleep_until(due);
    const std::int64_t late = clock_time(CLOCK_MONOTONIC) - due;
    lateness.add(1e-9 * static_cast<double>(late > 0 ? late : 0));
    due += late / period * period;  // missed times are skipped
  }
  return lateness;
}

}  // namespace cleft
