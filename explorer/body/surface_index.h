// The nearest place of a surface, and what a ray meets of it.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>

#include "explorer/incision/surface_mesh.h"

namespace cleft {

/// A place of a surface.
struct SurfacePlace {
  int triangle = -1;
  Vec3 position;
  std::array<double, 3> weights{};  ///< of the triangle's corners; they add up to 1
};

/// Keeps a copy of the surface, which must have triangles.
class SurfaceIndex {
 public:
  explicit SurfaceIndex(SurfaceMesh surface);
  ~SurfaceIndex();
  SurfaceIndex(SurfaceIndex&&) noexcept;

  const SurfaceMesh& surface() const;
  SurfacePlace nearest(const Vec3& x) const;
  /// The nearest place of triangles whose normal is less than a right angle away from `normal`, within
  /// `reach`; its triangle is -1 if there is none.
  SurfacePlace nearest(const Vec3& x, const Vec3& normal, double reach) const;
  SurfacePlace nearest_on(int triangle, const Vec3& x) const;
  /// How far from `from`, in lengths of `way`, the segment to from + way first meets the surface, if it does.
  std::optional<double> meets(const Vec3& from, const Vec3& way) const;

 private:
  template <class Counts>
  SurfacePlace nearest_of(const Vec3& x, double reach, const Counts& counts) const;
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

/// Tells how far from a place, in a unit direction, the surface is; infinite beyond 100. Keeps the surface.
std::function<double(const Vec3& place, const Vec3& direction)> distance_to(
    std::shared_ptr<const SurfaceIndex> surface);

/// Tells how far from a place the nearest place of the surface is. Keeps the surface.
std::function<double(const Vec3& place)> least_distance_to(std::shared_ptr<const SurfaceIndex> surface);

}  // namespace cleft
