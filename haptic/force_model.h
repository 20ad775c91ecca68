// The force of the tissue in each tick. Paper, section 3.6: elastic along the normal before puncture, viscous
// drag after it.
//
//   free      the tip is in the air or in an open wound; the side of the blade may touch
//   contact   the tip is inside an intact surface: F = K depth n at the proxy
//   cutting   through the surface: F = -b v - R depth e tanh(v.e / v0), until the blade is free of tissue
//   again
#pragma once

#include <algorithm>
#include <array>

#include "haptic/contact_query.h"
#include "haptic/force_parameters.h"
#include "haptic/pose.h"

namespace cleft {

enum class Phase { free, contact, cutting };

class ForceModel {
 public:
  /// Stiffness and drag are limited to what the device can render. `period`: s between ticks.
  ForceModel(const ContactSurface& surface, const ForceParameters& parameters, const DeviceLimits& limits,
             double period);

  /// The force on the hand, N; dt: s since the last pose. Neither allocates memory nor waits.
  Vec3 update(const ScalpelPose& pose, double dt);

  Phase phase() const { return phase_; }
  double depth() const { return depth_; }  ///< mm, of the tip under the surface; 0 in free
  const Vec3& normal() const { return proxy_.normal; }
  const Vec3& proxy() const { return proxy_.position; }
  const Vec3& velocity() const { return velocity_; }  ///< mm/s, filtered
  double stored() const { return stored_; }           ///< N mm, energy of the elastic forces
  int punctures() const { return punctures_; }
  double last_puncture_force() const { return puncture_force_; }  ///< N, elastic force at the last puncture
  /// N/mm, as rendered where the surface's firmness is 1, and of the softest and the firmest puncture; 0 if
  /// there was none.
  double stiffness() const { return std::min(p_.stiffness, limits_.max_stiffness); }
  const std::array<double, 2>& puncture_stiffness() const { return softest_and_firmest_; }

 private:
  void begin(const ScalpelPose& pose);
  Vec3 in_the_air(const ScalpelPose& pose);
  Vec3 side_contact(const ScalpelPose& pose);
  Vec3 in_contact(const ScalpelPose& pose);
  Vec3 in_tissue(const ScalpelPose& pose, double dt);
  double stiffness_at(int triangle, const Vec3& place) const;
  Vec3 elastic(double stiffness, double depth, const Vec3& normal);
  bool find_contact(const Vec3& tip);
  void follow_skin(const Vec3& tip);
  double engagement(const Vec3& tip);
  double after_leap(const Vec3& tip) const;

  ForceParameters p_;
  DeviceLimits limits_;
  double period_, drag_;
  ContactReader reader_;
  Phase phase_ = Phase::free;
  bool started_ = false;
  std::uint64_t version_ = 0;
  Vec3 last_tip_, velocity_;
  SurfaceProxy proxy_;
  double depth_ = 0, stored_ = 0;
  double since_puncture_ = 0, puncture_force_ = 0, puncture_stiffness_ = 0, engaged_ = 1;
  std::array<double, 2> softest_and_firmest_{};
  Vec3 at_puncture_;
  int punctures_ = 0;
};

}  // namespace cleft
