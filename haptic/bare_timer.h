// A loop that wakes up and does the same few microseconds of work in registers, as a reference for lateness
// and compute time of the haptic loop: its times are those of the machine.
#pragma once

#include <atomic>

#include "haptic/loop_statistics.h"

namespace cleft {

struct BareTimer {
  TimeHistogram lateness;  ///< of waking up
  TimeHistogram compute;   ///< of the same 1,500 additions each time, by the thread's own CPU clock
};

/// Wakes at the rate (Hz) until `stop`, in the thread that calls it; with `real_time` it requests SCHED_FIFO.
BareTimer bare_timer(double rate, bool real_time, const std::atomic<bool>& stop);

}  // namespace cleft
