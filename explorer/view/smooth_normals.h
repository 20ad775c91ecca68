// Normals of a wound's surface: smooth within each part, and without a visible line ahead of the tip.
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "explorer/scene/wound_scene.h"

namespace cleft {

/// Normals of the vertices of some triangles of a surface. A vertex is a point of the surface.
class SmoothNormals {
 public:
  SmoothNormals(const WoundSurface& surface, const std::vector<std::array<int, 3>>& triangles_of_points);

  /// Unit vectors, one for each vertex, with the surface's points there. Coincident lips share their normals.
  void of(const std::vector<Vec3>& points, std::vector<Vec3>& normals) const;

  /// Fixes the normals of vertices for which `known` (by point of the surface) is not zero.
  void fix(const std::vector<Vec3>& known);

  const std::vector<int>& source() const { return source_; }  ///< the surface's point of every vertex
  const std::vector<std::array<int, 3>>& triangles() const { return triangles_; }  ///< of vertices
  /// Vertices at the same place at rest.
  const std::vector<std::pair<int, int>>& twins() const { return twins_; }

 private:
  void share_with_twins(const std::vector<Vec3>& points, std::vector<Vec3>& normals) const;
  void keep_fixed(std::vector<Vec3>& normals) const;
  /// Makes normals unit vectors, and those of added points the mean of their neighbours': otherwise the
  /// facets of large flat triangles that a cut has refined would be visible.
  void soften(std::vector<Vec3>& normals) const;

  std::vector<int> source_;
  std::vector<std::array<int, 3>> triangles_;
  std::vector<std::pair<int, int>> twins_;
  std::vector<int> added_;  // vertices, by the cut
  std::vector<std::pair<int, Vec3>> fixed_;
};

constexpr int softening_passes = 4;  ///< rings of neighbours that a normal depends on, besides the first

}  // namespace cleft
