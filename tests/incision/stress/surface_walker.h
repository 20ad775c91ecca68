// Straight on over a surface: curves for paths, made without any of the incision's code that decides.
#pragma once

#include <vector>

#include "explorer/incision/cut_mesh.h"

namespace cleft::stress {

/// A mesh to walk on: normals of its vertices, weighted by area.
struct Ground {
  explicit Ground(const SurfaceMesh& surface);
  Vec3 normal(int triangle, const Vec3& place) const;
  Vec3 face_normal(int triangle) const;
  double edge_length(int triangle) const;  ///< mean

  CutMesh mesh;
  std::vector<Vec3> vertex_normals;
};

/// A place with a heading. Over edges the triangles are unfolded, so that a walk without turns is straight.
class SurfaceWalker {
 public:
  SurfaceWalker(const Ground& ground, int triangle, const Vec3& place, const Vec3& heading);

  /// False, and no further, where the surface ends or folds by more than 78 degrees.
  bool go(double length);
  void turn(double angle);  ///< counter-clockwise, radians

  const Vec3& place() const { return place_; }
  const Vec3& heading() const { return heading_; }
  int triangle() const { return triangle_; }
  bool at_boundary() const { return at_boundary_; }
  Vec3 normal() const { return ground_.normal(triangle_, place_); }

 private:
  const Ground& ground_;
  int triangle_;
  Vec3 place_, heading_;
  bool at_boundary_ = false;
};

}  // namespace cleft::stress
