// The skin of a body, and the walls of its cuts: parted along the cuts.
#pragma once

#include <array>
#include <map>
#include <vector>

#include "explorer/body/surface_index.h"
#include "solver/body/body.h"

namespace cleft {

/// Neighbours share their nodes: there are none across a cut.
class PartedSurface {
 public:
  /// `closed`, by node, if any: both walls of a cut have it, and an edge between two of them parts walls.
  explicit PartedSurface(SurfaceMesh mesh, const std::vector<bool>& closed = {});

  /// The nearest place, within `reach`, whose normal is less than a right angle away from `normal`; its
  /// triangle is -1 if there is none.
  SurfacePlace nearest(const Vec3& x, const Vec3& normal, double reach) const {
    return index_.nearest(x, normal, reach);
  }
  /// The nearest place that is reached from a triangle without going further away, nor across a cut.
  SurfacePlace nearest_from(int triangle, const Vec3& x) const;

  /// Some triangle at a node, -1 if there is none.
  int triangle_at(int node) const;
  const std::array<int, 3>& nodes(int triangle) const { return index_.surface().triangles[triangle]; }

 private:
  SurfaceIndex index_;
  std::vector<std::array<int, 3>> next_;  // by triangle, the neighbour at each edge; -1: none
  std::map<int, int> at_node_;
};

/// The walls of a body's cuts: faces of one wedge that lie on another one.
SurfaceMesh walls_of(const Body& body);

}  // namespace cleft
