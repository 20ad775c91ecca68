// The scalpel's path: C(s) with outward direction N(s) and depth(s). Paper, section 3.4.
#pragma once

#include <string>
#include <vector>

#include "base/text.h"
#include "base/vec3.h"

namespace cleft {

/// The blade's orthonormal frame at s. Right-handed (u, v, w): along = T made perpendicular to N, outward =
/// N, across = N x T. Left of the cut the component along `across` is negative.
struct PathFrame {
  Vec3 position, along, across, outward;
};

/// Coordinates of a point relative to the path: x = C(s) + v B(s) + w N(s), all in the path's units.
struct PathCoordinates {
  double s = 0, v = 0, w = 0;
};

class ScalpelPath {
 public:
  struct Point {
    Vec3 position, outward;
    double depth = 0;
  };

  /// Needs at least two different positions, and at most 20,000; steps of no length are merged. Throws
  /// InputError, also for coordinates above 1e60, directions of no length, and paths shorter than 1e-50.
  explicit ScalpelPath(const std::vector<Point>& points);

  /// Columns x, y, z, nx, ny, nz and, where present, depth; all in the mesh's units. Other columns must be
  /// among `further` and are ignored. Throws InputError naming `name` and the row.
  static ScalpelPath from_table(const NumberTable& table, const std::string& name,
                                const std::vector<std::string>& further = {});

  double length() const { return samples_.back().s; }

  /// The arc lengths of the points that the path was made of or extended to, increasing. Between them it is
  /// interpolated: in its first and last interval it bends less than the points do.
  std::vector<double> given() const;

  /// For a path that is not known in advance: keeps the path up to s, continues from there smoothly to
  /// `next`, and straight for `beyond`. Returns the arc length of `next`. Throws InputError if the direction
  /// is tangential to the path, which is then unchanged.
  double extend(double s, const Point& next, double beyond);

  /// The same path elsewhere.
  ScalpelPath moved(const Vec3& by) const;

  /// The same path in other units: all lengths times `by`.
  ScalpelPath scaled(double by) const;

  /// Its part up to s, within it.
  ScalpelPath until(double s) const;

  /// The frame at arc length s; before 0 and beyond length() it is extended straight along T.
  PathFrame at(double s) const;

  /// The depth at s; 0 if the path has none.
  double depth(double s) const;
  double largest_depth() const;
  double smallest_depth() const;
  void set_depth(double depth);

  /// Coordinates of x by the nearest place of the path with arc length in [from, to]; v = 0 is the blade's
  /// ruled surface C(s) + w N(s). Only the ends of the path itself are extended.
  PathCoordinates coordinates(const Vec3& x, double from, double to) const;
  PathCoordinates coordinates(const Vec3& x) const;

  /// The place of the path that x, with coordinates `at`, belongs to: a mean around the nearest one, over a
  /// way in proportion to the distance |v|, of what each place takes for the foot of x. It changes smoothly
  /// from point to point where the nearest place jumps: on the inner side of bends, and beside the tremor of
  /// a hand. Exactly at.s beside a straight path, and for v = 0.
  double steady_place(const Vec3& x, const PathCoordinates& at) const;

  /// The distance from C(s), to the left or the right, up to which C(s) is the nearest point of the path: in
  /// a bend up to its centre of curvature; infinite for a straight path.
  double room(double s, bool right) const;

 private:
  struct Sample {
    double s;
    Vec3 position, tangent, outward;
    double depth;
    bool given = false;  // one of the points
  };
  std::size_t interval(double s) const;
  Sample sample_at(double s) const;

  std::vector<Sample> samples_;  // cubic Hermite between them; several to each input segment
};

}  // namespace cleft
