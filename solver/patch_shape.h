// The shape of a patch: where the places of its grid are in space when the cut curves, the skin bulges or the
// bottom slopes, and the coordinates of the cut there.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "base/vec3.h"
#include "params/cut_curve.h"
#include "params/parameters/parameters.h"

namespace cleft {

/// A curve with a frame that turns with it (Darboux): T along it, N the normal of the surface that it is on,
/// B = N x T. Starts at 0 in the middle, along the first axis, with N along the third. Integrated by the
/// classical Runge-Kutta method in steps of a twentieth of a millimetre and interpolated by cubics: exact to
/// about 1e-8 mm.
class FramedCurve {
 public:
  /// Per mm along the curve, functions of the arc length: T' = bend B - normal N, B' = -bend T - twist
  /// N, N' = normal T + twist B.
  struct Rates {
    double bend = 0, normal = 0, twist = 0;
  };
  struct Place {
    Vec3 at, t, b, n;
  };

  /// Straight beyond `reach` to either side, mm.
  FramedCurve(std::function<Rates(double)> rates, double reach);

  Place operator()(double s) const;
  Rates rates(double s) const { return rates_(s); }

 private:
  void integrate(double step, std::vector<Place>& places) const;

  std::function<Rates(double)> rates_;
  double step_;
  std::vector<Place> forward_, back_;
};

/// A curvature of 1 in the middle, which then changes its sign and turns what it has turned back: from `core`
/// on it falls to -1 over half of that like a cosine, remains there, and rises to 0. Its integral over either
/// half is 0.
class TurnAndBack {
 public:
  explicit TurnAndBack(double core);  ///< mm
  double operator()(double s) const;
  double reach() const { return end_; }  ///< 0 from there on, mm

 private:
  double core_, fall_, plateau_, end_;
};

/// The curvature of a curved cut's path through its patch. Beyond the ends of the cut it goes on for 1 mm,
/// and then each side turns back what it has turned: from what it is there, like a cosine, to as much on the
/// other side as takes about as long as the cut's half, and back to 0.
class BendAndBack {
 public:
  explicit BendAndBack(const Parameters& parameters);
  double operator()(double s) const;
  double reach() const;     ///< 0 from there on, mm
  double greatest() const;  ///< of its absolute values

 private:
  struct Half {
    double at_end, back, plateau;
  };
  Half half(double way) const;

  double curvature_, rate_, core_, fall_;
  std::array<Half, 2> halves_;  // ahead, and behind
};

/// Maps (u, v, w) of a patch whose cut is straight onto the shaped one. Three maps in turn:
///
/// - bottom: below the cut w is stretched, so that the bottom is `slope` mm deeper for each mm toward +v;
/// - plane: (u, v) -> C(u) + g(v) N(u) + (v - g(v)) e_y, with the curve C of the cut (CutCurve) and its
///   normal N. g(v) is v near the curve and never reaches its evolute. The curve turns back beyond the cut's
///   ends, so that the patch is a strip of its width;
/// - surface: (x, y) -> C2(x) + a(y) B(x) + b(y) N(x): a curve of normal curvature skin.curvature_u and
///   geodesic torsion skin.curvature_uv, with a profile (a, b) of curvature skin.curvature_v across it. The
///   curvatures are constant near the cut and turn back beyond, so that the patch does not meet itself; the
///   torsion is constant. Depth is along the surface's normal.
class PatchShape {
 public:
  explicit PatchShape(const Parameters& parameters);

  /// mm below the skin of a place of the grid at (v, w), w <= 0.
  double depth(double v, double w) const;
  /// The place in space of (u, v) at a depth below the skin, mm.
  Vec3 place(double u, double v, double depth) const;
  /// Of the map of the plane: its determinant, 1 for a straight cut.
  double plane_determinant(double u, double v) const;
  /// The direction in space, within the skin, of the plane's first axis at (u, v); unit.
  Vec3 tension(double u, double v) const;

  /// Coordinates of the cut at (u, v): its arc length at the nearest place, from its middle, with straight
  /// continuations beyond its ends; and the distance, positive toward +v. (u, v) itself for a straight cut,
  /// and on it.
  std::array<double, 2> coordinates(double u, double v) const;
  /// The directions along the cut, across it and out of the skin at such a place of the cut; unit vectors.
  std::array<Vec3, 3> frame(double along) const;

 private:
  struct Plane {
    double x, y;
  };
  struct Surface {
    Vec3 at, x, y, normal;  // derivatives by x and y
  };
  Plane in_plane(double u, double v) const;
  Surface surface(double x, double y) const;
  double across(double v) const;  // g
  double across_slope(double v) const;

  CutCurve cut_;                       // the mesh's
  bool flat_;                          // the skin
  double slope_, height_, cut_depth_;  // of the bottom
  BendAndBack bend_;
  TurnAndBack along_turn_, across_turn_;
  FramedCurve path_, spine_, profile_;
};

}  // namespace cleft
