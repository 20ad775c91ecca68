// The passivity controller between force model and device: the rendered force creates no energy, is within
// the device's limit, and changes imperceptibly in each tick. A time-domain passivity observer and controller
// (Hannaford and Ryu 2002).
//
// A force that is held through a tick does exactly the work F . (x' - x), so the energy that the hand
// receives is known without a model, also with a known latency. The energy tank is filled by the work of the
// hand, never above the energy of the tissue's springs plus an allowance, and emptied by the work on the
// hand. A force is rendered as far as the tank pays until the force, and those under way to the device, could
// be reduced to zero at the permitted change in each tick.
#pragma once

#include <array>

#include "base/vec3.h"
#include "haptic/force_parameters.h"

namespace cleft {

class PassivityControl {
 public:
  PassivityControl(const ForceParameters& parameters, const DeviceLimits& limits, double period);

  /// The force to render, N. `position`: mm; `velocity`: mm/s; `wanted`: N, the model's force; `stored`: N
  /// mm, energy of the model's springs; dt: s since the last call.
  Vec3 update(const Vec3& position, const Vec3& velocity, const Vec3& wanted, double stored, double dt);

  /// After a gap in the poses: no work is counted over it, and the force starts from zero.
  void restart();

  double delivered() const { return delivered_; }  ///< N mm, net work on the hand so far
  /// Largest energy that a contact has created: work on the hand minus work of the hand, N mm.
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
      under_way_{};  ///< forces sent and not yet acting, the oldest first, and the one acting
  Vec3 last_position_;
  bool started_ = false;
  double tank_, delivered_ = 0, created_ = 0, contact_ = 0, idle_ = 0;
};

}  // namespace cleft
