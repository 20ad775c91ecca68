// The triangles of a contact surface, in two states each and with the plane that rules most of them out.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>

#include "base/vec3.h"
#include "haptic/triangle_geometry.h"

namespace cleft {

/// The current value of an object and its value one step before, in one cache line.
template <class T>
class alignas(64) TwoStates {
 public:
  /// The value at step `version`, of the last two steps.
  const T& at(std::uint64_t version) const {
    const std::uint64_t state = state_.load(std::memory_order_acquire);
    return value_[(state & 1) ^ static_cast<std::uint64_t>((state >> 1) > version)];
  }
  const T& last() const { return value_[state_.load(std::memory_order_relaxed) & 1]; }
  /// The value from step `version` on.
  void set(const T& value, std::uint64_t version) {
    const std::uint64_t state = state_.load(std::memory_order_relaxed);
    const std::uint64_t index = (state >> 1) == version ? state & 1 : (state & 1) ^ 1;
    value_[index] = value;
    state_.store(version << 1 | index, std::memory_order_release);
  }

 private:
  std::atomic<std::uint64_t> state_{0};
  T value_[2]{};
};

struct ContactTriangle {
  std::array<int, 3> vertex{-1, -1, -1};  ///< counter-clockwise seen from outside; -1: no triangle
  bool wall = false;                      ///< of a wound, not skin
};

/// A stored triangle with its rounded plane n . x = d, which rules out most triangles near a segment. Both
/// states fit into one cache line.
class StoredTriangle {
 public:
  StoredTriangle() = default;
  explicit StoredTriangle(const ContactTriangle& t) : vertex_(t.vertex) {
    if (t.wall) vertex_[2] |= wall_bit;
  }
  ContactTriangle triangle() const {
    return {{vertex_[0], vertex_[1], vertex_[0] < 0 ? vertex_[2] : vertex_[2] & ~wall_bit}, wall()};
  }
  bool exists() const { return vertex_[0] >= 0; }
  bool wall() const { return exists() && (vertex_[2] & wall_bit); }

  void set_plane(const Corners& c) {
    const Vec3 normal = scaled_normal(c);
    const double size = norm(normal);
    // A sliver's normal is mostly rounding: it has no plane, and nothing is ruled out by it.
    const bool sliver = size <= 1e-6 * (squared_norm(c[1] - c[0]) + squared_norm(c[2] - c[0]));
    const Vec3 n = sliver ? Vec3{} : 1 / size * normal;
    for (int k = 0; k < 3; ++k) plane_[k] = static_cast<float>(n[k]);
    plane_[3] = static_cast<float>(dot(n, c[0]));
  }
  /// Whether both ends are certainly on the same side; `rounding`: their of_rounding().
  bool on_one_side(const Vec3& from, const Vec3& to, double rounding) const {
    const double a = height(from), b = height(to), margin = rounding + unit * std::abs(plane_[3]);
    return (a > margin && b > margin) || (a < -margin && b < -margin);
  }
  /// A certain lower bound of the squared distance of x.
  double least_squared_distance(const Vec3& x) const {
    const double away = std::abs(height(x)) - of_rounding(x, x) - unit * std::abs(plane_[3]);
    return away > 0 ? away * away : 0;
  }
  /// A bound of the error of n . x by the rounding of n.
  static double of_rounding(const Vec3& from, const Vec3& to) {
    const auto size = [](const Vec3& x) { return std::abs(x.x) + std::abs(x.y) + std::abs(x.z); };
    return unit * std::max(size(from), size(to));
  }

 private:
  double height(const Vec3& x) const { return dot({plane_[0], plane_[1], plane_[2]}, x) - plane_[3]; }

  static constexpr int wall_bit = 1 << 30;
  static constexpr double unit = 1.2e-7;  // twice the relative rounding to 24 bits
  std::array<int, 3> vertex_{-1, -1, -1};
  float plane_[4]{};
};
static_assert(sizeof(TwoStates<StoredTriangle>) == 64);

}  // namespace cleft
