#include "haptic/loop.h"

#include <algorithm>

#include "base/error.h"
#include "base/text.h"
#include "haptic/real_time.h"

namespace cleft {

namespace {

constexpr double seconds_late = 4;  // that the thread which cuts may be busy

double checked_period(const LoopOptions& options) {
  if (!(options.rate >= 100 && options.rate <= 10000))
    throw InputError("a haptic loop of " + shortest(options.rate) + " Hz: from 100 to 10000 Hz");
  return 1 / options.rate;
}

/// For the plain model: a spring as it is.
DeviceLimits undamped(DeviceLimits limits) {
  limits.max_damping = 0;
  return limits;
}

}  // namespace

HapticLoop::HapticLoop(Device& device, const ContactSurface& surface, const ForceParameters& parameters,
                       const LoopOptions& options)
    : device_(device),
      options_(options),
      parameters_(parameters),
      limits_(device.limits()),
      model_(surface, parameters, options.passive ? limits_ : undamped(limits_), checked_period(options)),
      passivity_(parameters, limits_, 1 / options.rate),
      for_cutting_(static_cast<std::size_t>(seconds_late * options.rate)) {
  recorded_.resize(options.record);  // touches the pages before a tick does
  recorded_.clear();
}

void HapticLoop::update(double dt) {
  state_.time += dt;
  const bool was_present = state_.pose.present;
  state_.pose = device_.read(state_.time);
  if (recorded_.size() < recorded_.capacity()) recorded_.push_back({state_.time, state_.pose});
  if (state_.pose.present && !was_present) passivity_.restart();
  const Vec3 wanted = model_.update(state_.pose, dt);
  Vec3 force;
  if (state_.pose.present)
    force = options_.passive
                ? passivity_.update(state_.pose.tip, model_.velocity(), wanted, model_.stored(), dt)
                : wanted;
  device_.command(force);
  if (state_.pose.present && was_present) count(force);
  ++state_.tick;
  ++statistics_.ticks;
  state_.force = force;
  state_.phase = model_.phase();
  state_.depth = model_.depth();
  state_.proxy = model_.proxy();
  state_.normal = model_.normal();
  state_.punctures = model_.punctures();
  for_cutting_.push(state_);
  for_view_.write(state_);
}

void HapticLoop::count(const Vec3& force) {
  const double change = norm(force - state_.force);
  const double permitted = parameters_.change * norm(state_.force) + parameters_.floor;
  LoopStatistics& s = statistics_;
  s.largest_force = std::max(s.largest_force, norm(force));
  s.largest_change = std::max(s.largest_change, change);
  s.excess_change = std::max(s.excess_change, change - permitted * (1 + 1e-12));
}

void HapticLoop::run(const std::atomic<bool>& stop, std::optional<double> seconds) {
  const TickingThread thread(options_.real_time);
  refused_ = thread.refused();
  const auto period = static_cast<std::int64_t>(static_cast<double>(clock_second) / options_.rate);
  std::int64_t due = clock_time(CLOCK_MONOTONIC);
  const std::int64_t begin = due;
  const auto is_over = [&] {  // the time of a simulated hand grows by the ticks that are missed
    return static_cast<double>(due - begin) >=
           seconds.value_or(device_.duration()) * static_cast<double>(clock_second);
  };
  std::int64_t missed = 0;
  const std::int64_t faults_before = page_faults();
  while (!is_over() && !stop.load(std::memory_order_relaxed)) {
    due += period * (1 + missed);
    be_awake_at(due);
    const std::int64_t woken = clock_time(CLOCK_MONOTONIC);
    statistics_.lateness.add(1e-9 * static_cast<double>(std::max<std::int64_t>(woken - due, 0)));
    const std::int64_t before = options_.measure ? clock_time(CLOCK_THREAD_CPUTIME_ID) : 0;
    update(static_cast<double>(1 + missed) / options_.rate);
    if (options_.measure)
      statistics_.compute.add(1e-9 * static_cast<double>(clock_time(CLOCK_THREAD_CPUTIME_ID) - before));
    missed = std::max<std::int64_t>(0, (clock_time(CLOCK_MONOTONIC) - due) / period);
    if (missed == 0) continue;
    statistics_.missed += static_cast<std::uint64_t>(missed);
    if (statistics_.overruns < statistics_.overrun_ticks.size())
      statistics_.overrun_ticks[statistics_.overruns] = state_.tick;
    ++statistics_.overruns;
  }
  statistics_.page_faults = page_faults() - faults_before;
  state_.force = {};
  device_.command({});
}

}  // namespace cleft
