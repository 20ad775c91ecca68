#include "haptic/passivity.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace cleft {

namespace {
constexpr double rest = 0.05;  // s without a force, after which a contact is a new one
}

PassivityControl::PassivityControl(const ForceParameters& parameters, const DeviceLimits& limits,
                                   double period)
    : p_(parameters),
      max_force_(limits.max_force),
      period_(period),
      late_(static_cast<int>(std::ceil(limits.latency / period - 1e-9))),
      tank_(parameters.energy_allowance) {
  if (late_ >= most_late)
    throw InputError("the device answers " + std::to_string(limits.latency * 1e3) +
                     " ms late; forces are safe up to " + std::to_string((most_late - 1) * period * 1e3) +
                     " ms at this rate");
}

void PassivityControl::restart() {
  started_ = false;
  under_way_ = {};
  tank_ = p_.energy_allowance;
  contact_ = idle_ = 0;
}

Vec3 PassivityControl::update(const Vec3& position, const Vec3& velocity, const Vec3& wanted, double stored,
                              double dt) {
  if (started_) observe(position, stored, dt);
  const Vec3 moved = 1 / dt * (position - last_position_);
  last_position_ = position;
  const double size = norm(wanted);
  Vec3 force = wanted;
  if (size > 0) {
    // How fast the hand may take energy out by the time the force acts; the filtered velocity lags behind.
    const double away = started_ ? std::max(dot(velocity, wanted), dot(moved, wanted)) / size : 0;
    const double speed = away + p_.hand_acceleration * (late_ + 1) * period_;
    if (speed > 0) force *= affordable(size, speed) / size;
  }
  started_ = true;
  force = limited(force);
  std::copy(under_way_.begin() + 1, under_way_.begin() + late_ + 1, under_way_.begin());
  under_way_[late_] = force;
  return force;
}

void PassivityControl::observe(const Vec3& position, double stored, double dt) {
  // [0] has acted since the last position.
  const double work = dot(under_way_[0], position - last_position_);
  delivered_ += work;
  contact_ += work;
  created_ = std::max(created_, contact_);
  tank_ = std::min(tank_ - work, stored + p_.energy_allowance);
  bool none = true;
  for (int k = 0; k <= late_; ++k) none = none && under_way_[k] == Vec3{};
  idle_ = none ? idle_ + dt : 0;
  if (idle_ < rest) return;
  tank_ = p_.energy_allowance;
  contact_ = 0;
}

/// N s until a force is gone that falls by the permitted change each tick: the integral of
/// dF/dt = -(change F + floor) / T, and the tick it begins with.
double PassivityControl::taking_back(double force) const {
  const double c = p_.change, f = p_.floor;
  return period_ * (force / c - f / (c * c) * std::log1p(c * force / f) + force);
}

/// As much of `wanted` as the tank pays for at this speed, which the force itself raises while it is taken
/// back.
double PassivityControl::affordable(double wanted, double speed) const {
  double under_way = 0;
  for (int k = 1; k <= late_; ++k) under_way += period_ * norm(under_way_[k]);
  const auto paid = [&](double force) {
    constexpr double joule = 1e3;  // N mm
    const double impulse = under_way + taking_back(force);
    return impulse * speed + joule * impulse * impulse / (2 * p_.moving_mass) <= tank_;
  };
  if (paid(wanted)) return wanted;
  double low = 0, high = wanted;
  for (int k = 0; k < 12; ++k) (paid((low + high) / 2) ? low : high) = (low + high) / 2;
  return low;
}

Vec3 PassivityControl::limited(const Vec3& wanted) const {
  const Vec3& last = under_way_[late_];
  Vec3 force = squared_norm(wanted) > max_force_ * max_force_ ? max_force_ / norm(wanted) * wanted : wanted;
  const Vec3 step = force - last;
  const double most = p_.change * norm(last) + p_.floor, size = norm(step);
  if (size > most) force = last + most / size * step;
  return force;
}

}  // namespace cleft
