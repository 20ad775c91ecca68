// A loop that does nothing but wake up: what lateness of the haptic loop is compared with.
#pragma once

#include <atomic>

#include "haptic/loop_statistics.h"

namespace cleft {

/// Wakes at the rate (Hz) until `stop`, in the thread that calls it; with `real_time` it asks for SCHED_FIFO.
TimeHistogram bare_timer(double rate, bool real_time, const std::atomic<bool>& stop);

}  // namespace cleft
