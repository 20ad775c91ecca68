#include "explorer/scalpel/live_scalpel.h"

#include <algorithm>

#include "haptic/real_time.h"

namespace cleft {

namespace {
constexpr double for_ever = 1e9;  // s
/// Steps of the mesh a second: a picture each.
constexpr int steps_a_second = 60;

ScalpelCutting::Setup by_the_clock(ScalpelCutting::Setup setup) {
  setup.wait_for_guard = false;
  return setup;
}
}  // namespace

LiveScalpel::LiveScalpel(const SurfaceMesh& mesh, ScalpelCutting::Setup setup, Device& device,
                         const ForceParameters& force)
    : cutting_(mesh, by_the_clock(std::move(setup))),
      loop_(device, cutting_.surface(), force, {}),
      moment_(moment_of(cutting_, nullptr)),
      ticks_([this] { loop_.run(stop_, for_ever); }),
      cuts_([this] { follow(); }) {}

LiveScalpel::~LiveScalpel() { stop(); }

std::vector<LiveScalpel::Places> LiveScalpel::stop() {
  stop_ = true;
  for (std::thread* thread : {&ticks_, &cuts_})
    if (thread->joinable()) thread->join();
  cutting_.end_cut();
  tell();
  return ended_cuts();
}

void LiveScalpel::follow() {
  repeat(
      clock_second / steps_a_second, [this] { return stop_.load(); },
      [this] {
        cutting_.step(loop_.for_cutting());
        tell();
      });
}

void LiveScalpel::tell() {
  const std::size_t ended = cutting_.free_cuts().size() - (cutting_.cutting() ? 1 : 0);
  const std::string& stopped = cutting_.figures().stopped;
  std::shared_ptr<const CuttingMoment> next;
  if (wanted_.exchange(false)) next = moment_of(cutting_, moment_.get());
  if (!next && ended == ended_count_ && stopped == stopped_before_) return;
  const std::lock_guard lock(mutex_);
  if (next) moment_ = std::move(next);
  ended_.insert(ended_.end(), cutting_.free_cuts().begin() + static_cast<std::ptrdiff_t>(ended_count_),
                cutting_.free_cuts().begin() + static_cast<std::ptrdiff_t>(ended));
  ended_count_ = ended;
  if (stopped != stopped_before_) stopped_ = stopped_before_ = stopped;
}

std::shared_ptr<const CuttingMoment> LiveScalpel::moment() {
  const std::lock_guard lock(mutex_);
  wanted_ = true;
  return moment_;
}

std::vector<LiveScalpel::Places> LiveScalpel::ended_cuts() {
  const std::lock_guard lock(mutex_);
  return std::exchange(ended_, {});
}

std::string LiveScalpel::stopped() {
  const std::lock_guard lock(mutex_);
  return std::exchange(stopped_, {});
}

}  // namespace cleft
