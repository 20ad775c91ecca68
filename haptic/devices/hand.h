// A simulated hand: a mass held by a spring and a damper to a target that follows a script. It closes the
// force loop without hardware, optionally with a delay. Time passes for it tick by tick: where the loop
// misses ticks, the hand waits, because the force of one tick would otherwise push it for many.
#pragma once

#include <array>
#include <vector>

#include "haptic/device.h"

namespace cleft {

struct HandParameters {
  double mass = 0.1;       ///< kg, of hand and device
  double stiffness = 0.3;  ///< N/mm, of the grip around its target
  double damping = 0.008;  ///< N s/mm
  double delay = 0;        ///< s from a pose to its force, in addition to the tick
  double period = 1e-3;    ///< s between ticks of the loop that drives it
  DeviceLimits limits;     ///< without the latency, which is the delay
};

/// A target of the hand, which moves straight from one to the next.
struct HandTarget {
  double time;  ///< s
  ScalpelPose pose;
  /// Whether the motion to it is a press: when the force falls to half, the surface has been punctured, and
  /// the hand continues to the next target from its position.
  bool press = false;
};

struct DeviceKind;
DeviceKind hand_device();

class Hand : public Device {
 public:
  /// Throws InputError for parameters out of range, no targets or times that do not increase.
  Hand(const HandParameters& parameters, std::vector<HandTarget> script);

  ScalpelPose read(double time) override;
  void command(const Vec3& force) override;
  DeviceLimits limits() const override;

  /// Upper bound, since a press may end early; it grows by the ticks that the loop misses.
  double duration() const override { return script_.back().time + lost_; }
  const Vec3& velocity() const { return velocity_; }  ///< mm/s
  /// Work of the force on the hand, N mm, from the actual motion, as a reference for the observer.
  double work() const { return work_; }

 private:
  static constexpr int most_late = 32, substeps = 4;
  ScalpelPose target(double time);
  void feel(double force);

  HandParameters p_;
  std::vector<HandTarget> script_;
  std::size_t at_ = 0;
  double time_ = 0;     // s, of the hand
  double lost_ = 0;     // s, of the ticks that the loop missed
  double saved_ = 0;    // s, by which presses ended early
  double pressed_ = 0;  // N, the largest force of a press
  int late_;
  std::array<Vec3, most_late> under_way_{};
  Vec3 position_, velocity_;
  double work_ = 0;
};

}  // namespace cleft
