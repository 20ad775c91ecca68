#include "haptic/force_model.h"

#include <algorithm>
#include <cmath>

namespace cleft {

namespace {
constexpr double most_side_depth = 1;  // mm: how deep a blade's side is looked for
constexpr double near = 0.5;           // mm: how far the skin is looked for where it was a moment ago
constexpr double most_over_skin = 5;   // mm: how far above a tip skin is looked for that it may be under
constexpr double touching = 1e-6;      // mm: nearer than that a tip is neither in nor out, to rounding
double smooth_step(double x) {
  x = std::clamp(x, 0., 1.);
  return x * x * (3 - 2 * x);
}
}  // namespace

ForceModel::ForceModel(const ContactSurface& surface, const ForceParameters& parameters,
                       const DeviceLimits& limits, double period)
    : p_(parameters),
      limits_(limits),
      period_(period),
      drag_(std::min(parameters.drag, limits.max_damping)),
      reader_(surface) {}

Vec3 ForceModel::update(const ScalpelPose& pose, double dt) {
  if (!pose.present || !started_) begin(pose);
  if (!pose.present) return {};
  const double share = dt / (p_.velocity_time + dt);
  velocity_ += share * (1 / dt * (pose.tip - last_tip_) - velocity_);
  stored_ = 0;
  const ContactLook look(reader_);
  Vec3 force;
  switch (phase_) {
    case Phase::free:
      force = in_the_air(pose);
      break;
    case Phase::contact:
      force = in_contact(pose);
      break;
    case Phase::cutting:
      force = in_tissue(pose, dt);
      break;
  }
  version_ = reader_.version();
  last_tip_ = pose.tip;
  return force;
}

void ForceModel::begin(const ScalpelPose& pose) {
  started_ = pose.present;
  phase_ = Phase::free;
  last_tip_ = pose.tip;
  velocity_ = {};
  depth_ = stored_ = 0;
}

/// N/mm, as it can be rendered, at a place of a triangle.
double ForceModel::stiffness_at(int triangle, const Vec3& place) const {
  return std::min(p_.stiffness * reader_.firmness(triangle, place), limits_.max_stiffness);
}

Vec3 ForceModel::elastic(double stiffness, double depth, const Vec3& normal) {
  // A force held for a tick, late by the latency, is a spring with negative damping of this size.
  const double damping = std::min(stiffness * (period_ / 2 + limits_.latency), limits_.max_damping);
  // The damping never pulls the hand into the surface.
  const double size = std::max(0., stiffness * depth - damping * dot(velocity_, normal));
  stored_ += stiffness * depth * depth / 2;
  return size * normal;
}

/// Whether the tip has come through a surface, or a surface over the tip.
bool ForceModel::find_contact(const Vec3& tip) {
  if (const SurfaceHit hit = reader_.first_contact(last_tip_, tip, Facing::front)) {
    proxy_ = {hit.triangle, dot(hit.position - last_tip_, hit.normal), hit.position, hit.normal, hit.wall};
    if (const SurfaceProxy better = reader_.proxy(tip, proxy_)) proxy_ = better;
    return true;
  }
  if (reader_.version() == version_) return false;
  const NearestPoint p = reader_.nearest(tip, most_side_depth);
  if (!p || p.distance >= 0) return false;
  proxy_ = {p.triangle, -p.distance, p.position, p.normal, p.wall};
  return true;
}

Vec3 ForceModel::in_the_air(const ScalpelPose& pose) {
  depth_ = 0;
  if (!find_contact(pose.tip)) return side_contact(pose);
  phase_ = Phase::contact;
  return in_contact(pose);
}

/// The blade crosses an edge of the surface: its deepest place is approximated by the middle of the part
/// inside.
Vec3 ForceModel::side_contact(const ScalpelPose& pose) {
  const Vec3 end = pose.tip + p_.blade_length * pose.axis;
  const SurfaceHit in = reader_.first_contact(pose.tip, end, Facing::front);
  if (!in) return {};
  const SurfaceHit out = reader_.first_contact(in.position, end, Facing::back);
  const Vec3 middle = lerp(in.position, out ? out.position : end, 0.5);
  const NearestPoint p = reader_.nearest(middle, most_side_depth);
  if (p && p.distance >= 0) return {};
  proxy_ = {-1, p ? -p.distance : most_side_depth, p ? p.position : middle, p ? p.normal : in.normal,
            in.wall};
  const double stiffness = p ? stiffness_at(p.triangle, p.position) : stiffness_at(in.triangle, in.position);
  return elastic(stiffness, proxy_.depth, proxy_.normal);
}

Vec3 ForceModel::in_contact(const ScalpelPose& pose) {
  SurfaceProxy proxy = reader_.proxy(pose.tip, proxy_);
  if (!proxy) {  // the triangle is gone, and none of those about it leads to the tip
    const Vec3 moved = pose.tip - last_tip_;
    const Vec3 beside = proxy_.position + moved - dot(moved, proxy_.normal) * proxy_.normal;
    if (const NearestPoint p = reader_.nearest(beside, most_side_depth))
      proxy = {p.triangle, dot(p.position - pose.tip, p.normal), p.position, p.normal, p.wall};
  }
  if (!proxy || proxy.depth < -touching) {
    phase_ = Phase::free;
    depth_ = 0;
    return {};
  }
  proxy_ = proxy;
  depth_ = std::max(0., proxy.depth);
  const double stiffness = stiffness_at(proxy.triangle, proxy.position);
  const Vec3 force = elastic(stiffness, depth_, proxy.normal);
  if (!pose.cutting || stiffness * depth_ < p_.puncture_force) return force;
  phase_ = Phase::cutting;
  ++punctures_;
  since_puncture_ = 0;
  engaged_ = 1;
  puncture_force_ = stiffness * depth_;
  puncture_stiffness_ = stiffness;
  auto& [softest, firmest] = softest_and_firmest_;
  softest = punctures_ == 1 ? stiffness : std::min(softest, stiffness);
  firmest = std::max(firmest, stiffness);
  at_puncture_ = force;
  return force;
}

/// The skin above a tip that has gone through it; over an open wound, where it was.
void ForceModel::follow_skin(const Vec3& tip) {
  const Vec3 moved = tip - last_tip_;
  const Vec3 beside = proxy_.position + moved - dot(moved, proxy_.normal) * proxy_.normal;
  const SurfaceHit hit =
      reader_.first_contact(beside + near * proxy_.normal, beside - near * proxy_.normal, Facing::front);
  proxy_.position = hit && !hit.wall ? hit.position : beside;
  if (hit && !hit.wall) proxy_.normal = normalized(lerp(proxy_.normal, hit.normal, 0.1));
  depth_ = std::max(0., dot(proxy_.position - tip, proxy_.normal));
}

/// Whether the tip is in tissue after all the skin that it has passed since the last tick. Walls do not
/// count: those of a nearly closed wound coincide, and the blade has just made them. Through an open wound a
/// tip passes no skin: over the skin that was followed, with none above it, it is out.
double ForceModel::after_leap(const Vec3& tip) const {
  constexpr int most = 8;
  if (depth_ == 0 && !reader_.first_contact(tip, tip + most_over_skin * proxy_.normal, Facing::back))
    return 0;
  const Vec3 way = tip - last_tip_;
  const double on = 2 * touching / std::max(norm(way), touching);
  double inside = engaged_, passed = 0;
  for (int k = 0; k < most && passed < 1; ++k) {
    const SurfaceHit hit = reader_.first_contact(last_tip_ + passed * way, tip, Facing::any);
    if (!hit) break;
    if (!hit.wall) inside = dot(hit.normal, way) < 0 ? 1 : 0;
    passed += (1 - passed) * hit.fraction + on;
  }
  return inside;
}

/// 1 in tissue and between walls that touch the blade, 0 in the air and in a wound wide open.
double ForceModel::engagement(const Vec3& tip) {
  const double thickness = p_.blade_half_thickness;
  const NearestPoint p = reader_.nearest(tip, 4 * thickness);
  if (!p) return after_leap(tip);  // far from all surface: as before, but for what was passed at once
  if (p.distance <= thickness) return 1;
  return std::max(0., 2 - p.distance / thickness);
}

Vec3 ForceModel::in_tissue(const ScalpelPose& pose, double dt) {
  since_puncture_ += dt;
  follow_skin(pose.tip);
  engaged_ = engagement(pose.tip);
  const double given = smooth_step(since_puncture_ / p_.puncture_time);
  stored_ = (1 - given) * (1 - given) * squared_norm(at_puncture_) / (2 * puncture_stiffness_);
  if (engaged_ == 0 && given == 1) {
    phase_ = Phase::free;
    depth_ = 0;
    return {};
  }
  const double along = dot(velocity_, pose.edge);
  const double resistance = p_.cutting_resistance * std::min(depth_, p_.blade_length);
  const Vec3 post = -drag_ * velocity_ - resistance * std::tanh(along / p_.resistance_speed) * pose.edge;
  return (1 - given) * at_puncture_ + given * engaged_ * post;
}

}  // namespace cleft
