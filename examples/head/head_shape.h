// A stylised human head as an implicit surface: smooth blends of ellipsoids and capsules.
//
// Lengths in mm. The eyes are at y = 0; x points to the head's left, y up and z forward.
#pragma once

#include <vector>

#include "base/vec3.h"

namespace cleft::head {

/// Negative inside, zero on the skin, about the distance near it.
double distance(const Vec3& p);

/// Its gradient, of length about 1: the outward normal's direction.
Vec3 gradient(const Vec3& p);

/// The nearby point of the surface (Newton's method along the gradient).
Vec3 project(Vec3 p);

/// The wanted edge length of a triangle here, relative to the smooth back of the head: finer where the shape
/// is.
double relative_edge_length(const Vec3& p);

/// A box that holds the head with a few mm to spare.
struct Box {
  Vec3 low, high;
};
Box bounds();

struct PathPoint {
  Vec3 position, normal;  ///< on the surface; unit and outward
};

/// A scalpel's path over the left cheek, from below the ear in a bow towards the chin; a point every `step`
/// mm.
std::vector<PathPoint> cheek_path(double step);

}  // namespace cleft::head
