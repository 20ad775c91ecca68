// A simulated hand: a mass held by a spring and a damper to a target that follows a script. It closes the
// force loop without hardware, with a delay where one is wanted.
#pragma once

#include <array>
#include <vector>

#include "haptic/device.h"

namespace cleft {

struct HandParameters {
  double mass = 0.1;       ///< kg, of hand and device
  double stiffness = 0.3;  ///< N/mm, of the grip about its target
  double damping = 0.008;  ///< N s/mm
  double delay = 0;        ///< s from a pose to the force that answers it, beyond the tick
  double period = 1e-3;    ///< s between ticks of the loop that drives it
  DeviceLimits limits;     ///< but for the latency, which is the delay
};

/// Where the hand wants to be: straight from one place to the next.
struct HandTarget {
  double time;  ///< s
  ScalpelPose pose;
  /// The way to it is a press: where the force falls to half of what it was, something gave way, and the hand
  /// goes on to the next target from where it is.
  bool press = false;
};

struct DeviceKind;
DeviceKind hand_device();

class Hand : public Device {
 public:
  /// Throws InputError for parameters out of range, no targets or times that do not grow.
  Hand(const HandParameters& parameters, std::vector<HandTarget> script);

  ScalpelPose read(double time) override;
  void command(const Vec3& force) override;
  DeviceLimits limits() const override;

  double duration() const override { return script_.back().time; }  ///< at most: a press may end early
  const Vec3& velocity() const { return velocity_; }                ///< mm/s
  /// N mm the force has done on the hand, with the motion as it was: the truth an observer is compared with.
  double work() const { return work_; }

 private:
  static constexpr int most_late = 32, substeps = 4;
  ScalpelPose target(double time);
  void feel(double force);

  HandParameters p_;
  std::vector<HandTarget> script_;
  std::size_t at_ = 0;
  double time_ = 0, saved_ = 0;  // s, by which presses ended early
  double pressed_ = 0;           // N, the largest force of a press
  int late_;
  std::array<Vec3, most_late> under_way_{};
  Vec3 position_, velocity_;
  double work_ = 0;
};

}  // namespace cleft
