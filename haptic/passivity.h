// Between the model and the device: no more energy than was put in, no more force than the device has, and no
// jump one would notice. A time-domain passivity observer and controller (Hannaford and Ryu 2002).
//
// A force held through a tick does exactly the work F . (x' - x), so what the tool has given to the hand is
// known without a model, also where the force comes late by a known latency. The rest is a tank: filled by
// what the hand puts in, never fuller than what the tissue's springs hold plus an allowance, emptied by what
// comes back. A force is rendered as far as the tank pays for it until it could be taken back, at the
// permitted change a tick, and those under way.
#pragma once

#include <array>

#include "base/vec3.h"
#include "haptic/force_parameters.h"

namespace cleft {

class PassivityControl {
 public:
  PassivityControl(const ForceParameters& parameters, const DeviceLimits& limits, double period);

  /// The force to render, N. `position` mm; `velocity` mm/s; `stored`: N mm the model's springs
  /// hold; dt: s since the last.
  Vec3 update(const Vec3& position, const Vec3& velocity, const Vec3& wanted, double stored, double dt);

  /// After a gap in the poses: no work is counted over it, and the force begins from none.
  void restart();

  double delivered() const { return delivered_; }  ///< N mm given to the hand so far, less what it put in
  /// Most that a contact has given beyond what was put into it: the energy created, N mm.
  double created() const { return created_; }
  double tank() const { return tank_; }

 private:
  static constexpr int most_late = 32;
  void observe(const Vec3& position, double stored, double dt);
  double affordable(double wanted, double speed) const;
  double taking_back(double force) const;
  Vec3 limited(const Vec3& wanted) const;

  ForceParameters p_;
  double max_force_, period_;
  int late_;
  std::array<Vec3, most_late>
      under_way_{};  ///< forces told and not yet acting, the oldest first, and the one acting
  Vec3 last_position_;
  bool started_ = false;
  double tank_, delivered_ = 0, created_ = 0, contact_ = 0, idle_ = 0;
};

}  // namespace cleft
