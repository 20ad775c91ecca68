#include "haptic/devices/hand.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/text.h"
#include "haptic/devices/device_kind.h"

namespace cleft {

Hand::Hand(const HandParameters& parameters, std::vector<HandTarget> script)
    : p_(parameters), script_(std::move(script)), late_(static_cast<int>(std::lround(p_.delay / p_.period))) {
  if (!(p_.mass > 0) || !(p_.stiffness >= 0) || !(p_.damping >= 0) || !(p_.period > 0))
    throw InputError("a hand needs a mass and a period above 0, and stiffness and damping of at least 0");
  if (!(p_.delay >= 0) || late_ >= most_late)
    throw InputError("a delay of " + shortest(1e3 * p_.delay) + " ms: from 0 to " +
                     shortest(1e3 * p_.period * (most_late - 1)) + " ms are simulated");
  if (script_.empty()) throw InputError("a hand needs a target");
  for (std::size_t i = 1; i < script_.size(); ++i)
    if (!(script_[i].time > script_[i - 1].time))
      throw InputError("target " + std::to_string(i + 1) + " of the hand, at " + shortest(script_[i].time) +
                       " s, must come after the one before it");
  position_ = script_.front().pose.tip;
}

DeviceLimits Hand::limits() const {
  DeviceLimits limits = p_.limits;
  limits.latency = late_ * p_.period;
  return limits;
}

ScalpelPose Hand::target(double time) {
  time += saved_;
  while (at_ + 2 < script_.size() && script_[at_ + 1].time <= time) ++at_;
  const HandTarget &a = script_[at_], &b = script_[std::min(at_ + 1, script_.size() - 1)];
  const double part = b.time > a.time ? std::clamp((time - a.time) / (b.time - a.time), 0., 1.) : 0;
  ScalpelPose pose = part < 1 ? a.pose : b.pose;
  pose.tip = lerp(a.pose.tip, b.pose.tip, part);
  pose.axis = normalized(lerp(a.pose.axis, b.pose.axis, part));
  pose.edge = normalized(lerp(a.pose.edge, b.pose.edge, part));
  return pose;
}

/// A press ends where what was pressed gives way.
void Hand::feel(double force) {
  constexpr double least = 0.1;  // N: less is noise of a contact
  const double now = time_ + saved_;
  std::size_t to = std::min(at_ + 1, script_.size() - 1);
  if (!script_[to].press || script_[to].time <= now) return;
  pressed_ = std::max(pressed_, force);
  if (pressed_ < least || force > pressed_ / 2) return;
  while (to + 1 < script_.size() && script_[to + 1].press) ++to;
  script_[to].pose.tip = position_;
  saved_ += script_[to].time - now;
  pressed_ = 0;
}

ScalpelPose Hand::read(double time) {
  constexpr double newton_per_kg = 1e3;  // mm/s^2
  const auto ticks = std::lround((time - lost_ - time_) / p_.period);
  if (ticks > 1) lost_ += static_cast<double>(ticks - 1) * p_.period;
  if (ticks > 0) {
    const Vec3 force = under_way_[0], before = position_;
    feel(norm(force));
    const double dt = p_.period / substeps;
    for (int k = 1; k <= substeps; ++k) {
      const Vec3 to = target(time_ + k * dt).tip - position_;
      velocity_ += newton_per_kg * dt / p_.mass * (p_.stiffness * to - p_.damping * velocity_ + force);
      position_ += dt * velocity_;
    }
    work_ += dot(force, position_ - before);
    time_ += p_.period;
    std::copy(under_way_.begin() + 1, under_way_.begin() + late_ + 1, under_way_.begin());
  }
  ScalpelPose pose = target(time_);
  pose.tip = position_;
  return pose;
}

void Hand::command(const Vec3& force) { under_way_[late_] = force; }

DeviceKind hand_device() {
  return {.name = "hand",
          .title = "Simulated &hand along a path ...",
          .help = "a simulated hand without hardware, that cuts along a path and feels the forces",
          .input = &path_input,
          .make = [](const DeviceRequest& request) -> std::unique_ptr<Device> {
            if (request.script.empty())
              throw InputError(std::string("the simulated hand follows the path of a cut: give ") +
                               path_input.option);
            return std::make_unique<Hand>(request.hand, request.script);
          }};
}

}  // namespace cleft
