#include "haptic/real_time.h"

#include <link.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>

#include <cerrno>
#include <cstring>

#include "base/error.h"
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

void be_awake_at(std::int64_t time) {
  constexpr std::int64_t awake = 60000;  // ns
  sleep_until(time - awake);
  while (clock_time(CLOCK_MONOTONIC) < time) {
  }
}

std::int64_t page_faults() {
  rusage usage;
  getrusage(RUSAGE_THREAD, &usage);
  return usage.ru_minflt + usage.ru_majflt;
}

namespace {

/// Reads a byte of every page of code, of the program and of its smaller libraries.
int touch_code(dl_phdr_info* object, std::size_t, void*) {
  constexpr std::size_t page = 4096, large = 8 << 20;
  for (int k = 0; k < object->dlpi_phnum; ++k) {
    const auto& part = object->dlpi_phdr[k];
    if (part.p_type != PT_LOAD || !(part.p_flags & PF_R) || (part.p_flags & PF_W) || part.p_memsz > large)
      continue;
    const auto* bytes = reinterpret_cast<const volatile char*>(object->dlpi_addr + part.p_vaddr);
    for (std::size_t at = 0; at < part.p_memsz; at += page) static_cast<void>(bytes[at]);
  }
  return 0;
}

void touch_stack() {
  volatile char stack[64 << 10];
  for (std::size_t at = 0; at < sizeof stack; at += 1024) stack[at] = 0;
}

}  // namespace

TickingThread::TickingThread(bool real_time)
    : slack_(prctl(PR_GET_TIMERSLACK)), policy_(sched_getscheduler(0)) {
  sched_getparam(0, &priority_);
  prctl(PR_SET_TIMERSLACK, 1UL);  // else a sleep may end 50 us late by design
  touch_stack();
  dl_iterate_phdr(touch_code, nullptr);
  if (!real_time) return;
  const sched_param priority{sched_get_priority_max(SCHED_FIFO) / 2};
  if (sched_setscheduler(0, SCHED_FIFO, &priority) != 0)
    refused_ = std::string("SCHED_FIFO: ") + std::strerror(errno);
  if (mlockall(MCL_CURRENT | MCL_FUTURE | MCL_ONFAULT) != 0)
    refused_ += (refused_.empty() ? "" : "; ") + std::string("locked memory: ") + std::strerror(errno);
}

TickingThread::~TickingThread() {
  sched_setscheduler(0, policy_, &priority_);
  prctl(PR_SET_TIMERSLACK, static_cast<unsigned long>(slack_));
}

BareTimer bare_timer(double rate, bool real_time, const std::atomic<bool>& stop) {
  const TickingThread thread(real_time);
  BareTimer bare;
  const auto period = static_cast<std::int64_t>(static_cast<double>(clock_second) / rate);
  double x = 1;
  for (std::int64_t due = clock_time(CLOCK_MONOTONIC); !stop;) {
    due += period;
    be_awake_at(due);
    const std::int64_t late = clock_time(CLOCK_MONOTONIC) - due;
    bare.lateness.add(1e-9 * static_cast<double>(late > 0 ? late : 0));
    const std::int64_t before = clock_time(CLOCK_THREAD_CPUTIME_ID);
    for (int k = 0; k < 1500; ++k) x = 0.5 * x + 1;  // some 3 us: each waits for the one before
    bare.compute.add(1e-9 * static_cast<double>(clock_time(CLOCK_THREAD_CPUTIME_ID) - before));
    CLEFT_CHECK(x, <, 3);
    due += late / period * period;  // missed times are skipped
  }
  return bare;
}

}  // namespace cleft
