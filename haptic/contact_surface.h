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
#include "haptic/stored_triangle.h"

namespace cleft {

/// Lengths are mm.
struct ContactSurfaceOptions {
  double cell = 0;  ///< voxel's edge; 0: three quarters of the triangles' mean edge
  double margin =
      -1;  ///< distance by which the surface may grow beyond its box; -1: a quarter of its diagonal
  std::size_t spare = 1 << 20;       ///< vertices and triangles that may be added
  std::vector<float> firmness = {};  ///< of each point: Moved; empty: 1 everywhere
};

class ContactSurface {
 public:
  struct Moved {
    int vertex;
    Vec3 position;
    /// Stiffness there over that of ForceParameters, of a surface that was made with such; 0: as it was.
    float firmness = 0;
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
  void set_vertex(const Moved& moved, std::uint64_t version);
  void touch(int triangle);
  void unlink(int triangle, int corner, int vertex);
  void renew_normal(int vertex, std::uint64_t version);
  void renew_normals(std::uint64_t version);

  ContactCells cells_;
  SlotArray<TwoStates<Vec3>> positions_;
  SlotArray<TwoStates<Vec3>> normals_;  // of the triangles around a vertex, weighted by area; unit, or 0
  SlotArray<TwoStates<StoredTriangle>> triangles_;
  bool firmness_differs_;
  SlotArray<std::atomic<float>> firmness_;  // of a vertex, if it differs
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
