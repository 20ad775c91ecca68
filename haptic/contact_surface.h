// The surface for haptic contact: triangles in a voxel grid. The cutting thread changes it in steps; the
// haptic thread reads complete steps and never waits.
//
//   ContactSurface surface(points, triangles, {});
//   surface.update(moved, changed);               one thread: a step, as long as what changed
//   ContactReader reader(surface);                another: contact_query.h
//
// Vertices and triangles have two states, the one of the last step and the one before; a reader announces the
// step it reads, and the writer waits for readers of the step before last before it overwrites their state.
#pragma once

#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "base/vec3.h"
#include "haptic/contact_cells.h"
#include "haptic/slot_array.h"

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
class FeltTriangle {
 public:
  FeltTriangle() = default;
  explicit FeltTriangle(const ContactTriangle& t) : vertex_(t.vertex) {
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
static_assert(sizeof(TwoStates<FeltTriangle>) == 64);

/// Lengths are mm.
struct ContactSurfaceOptions {
  double cell = 0;  ///< voxel's edge; 0: three quarters of the triangles' mean edge
  double margin =
      -1;  ///< distance by which the surface may grow beyond its box; -1: a quarter of its diagonal
  std::size_t spare = 1 << 20;  ///< vertices and triangles that may be added
};

class ContactSurface {
 public:
  struct Moved {
    int vertex;
    Vec3 position;
  };
  struct Changed {
    int triangle;
    ContactTriangle now;  ///< vertex[0] = -1: it is removed
  };

  ContactSurface(std::span<const Vec3> points, std::span<const std::array<int, 3>> triangles,
                 const ContactSurfaceOptions& options = {});

  /// One step: changed or new vertices and triangles. Work and memory are proportional to the change and its
  /// neighbourhood. Throws InputError if the surface outgrows `spare`.
  void update(std::span<const Moved> moved, std::span<const Changed> changed);
  /// Allocates memory for the next steps in advance, when there is time.
  void prepare();

  std::uint64_t version() const { return version_.load(std::memory_order_relaxed); }
  std::size_t vertex_count() const { return positions_.size(); }
  std::size_t triangle_count() const { return triangles_.size(); }  ///< including removed ones
  const Vec3& position(int v) const { return positions_[v].last(); }
  const ContactCells& cells() const { return cells_; }

 private:
  friend class ContactReader;
  static constexpr int most_readers = 4, none = -1;
  // The state of a reader: unused, idle, about to read the version, or the version it reads plus `reading`.
  static constexpr std::uint64_t unused = 0, idle = 1, entering = 2, reading = 3;

  Corners corners_at(const ContactTriangle& t, std::uint64_t version) const;
  int& next_corner(int corner) { return next_corner_[corner / 3][corner % 3]; }
  void wait_for_readers() const;
  void rebin(int id, std::uint64_t next);
  void leave_old_voxels();
  void set_triangle(int id, const ContactTriangle& now, std::uint64_t version);
  void set_vertex(int id, const Vec3& position, std::uint64_t version);
  void touch(int triangle);
  void unlink(int triangle, int corner, int vertex);
  void renew_normal(int vertex, std::uint64_t version);
  void renew_normals(std::uint64_t version);

  ContactCells cells_;
  SlotArray<TwoStates<Vec3>> positions_;
  SlotArray<TwoStates<Vec3>> normals_;  // of the triangles around a vertex, weighted by area; unit, or 0
  SlotArray<TwoStates<FeltTriangle>> triangles_;
  std::atomic<std::uint64_t> version_{1};
  mutable std::array<std::atomic<std::uint64_t>, most_readers> readers_{};

  // The writer's own: corners around a vertex as lists through corner numbers 3 * triangle + i.
  SlotArray<int> first_corner_;
  SlotArray<std::array<int, 3>> next_corner_;
  SlotArray<std::uint64_t> triangle_touched_, vertex_touched_;  // the step of the last touch
  std::vector<int> touched_, renewed_;
  std::vector<std::uint64_t> old_voxels_, new_voxels_;
  std::vector<std::pair<std::uint64_t, int>> left_;  // voxels and triangles that have left them
};

}  // namespace cleft
