// Surfaces with cuts, and bone below, of which bodies are made: for tests, and for the tables of tests/truth.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "explorer/incision/scalpel_path.h"
#include "explorer/incision/surface_mesh.h"

namespace cleft::testing {

/// From a place of a plane to the surface; x, y and the outward normal are right-handed.
using Bend = std::function<Vec3(double x, double y)>;

Vec3 flat(double x, double y);
Bend cylinder_along(double radius);   ///< its axis is along x
Bend cylinder_around(double radius);  ///< its axis is along y
Bend sphere_cap(double radius);
Bend saddle(double radius);                         ///< bent up along y and down along x
Bend torus_outside(double ring, double tube);       ///< x goes around the ring
Bend ridge(double slope, double width);             ///< along x; rounded over the width
Bend lamella(double half_width, double thickness);  ///< folded about x: the other side is below

/// Unit, outward.
Vec3 normal_of(const Bend& bend, double x, double y);

/// Squares of `edge`, each in two triangles, from -half_x to half_x and -half_y to half_y. Points within are
/// moved at random by up to `jitter` edges.
SurfaceMesh sheet(const Bend& bend, double half_x, double half_y, double edge, double jitter = 0,
                  unsigned seed = 1);

/// The same, `depth(x, y)` below.
Bend below(const Bend& bend, const std::function<double(double, double)>& depth);

/// Through places of the plane. The blade leans by `tilt` degrees to the right of the path.
ScalpelPath path_on(const Bend& bend, const std::vector<std::pair<double, double>>& places, double depth,
                    double tilt = 0);

/// An arc of so many mm about the origin, on its way through which it turns to the left.
std::vector<std::pair<double, double>> arc(double radius, double length);

struct Subject {
  std::string name;
  SurfaceMesh skin;
  std::vector<ScalpelPath> paths;
  std::optional<SurfaceMesh> bone;
};

/// The small ones that are solved a second time by other programs: axial and around (a cylinder of 60 mm),
/// bent (around one of 30 mm), sphere, plate (two cuts that cross), cross (on a sphere, above bone).
Subject small_subject(const std::string& name);

}  // namespace cleft::testing
