// The discontinuous free-form deformation (DFFD): a cubic B-spline over (u, v, w, t) with a C^-1 break across
// v = 0. Paper, sections 3.2 and 3.3. Lengths in mm; u along the cut, v across it (left < 0 < right), w
// height (skin 0, below < 0).
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "base/vec3.h"
#include "encoder/field/bspline.h"

namespace cleft {

/// On which side of the cut plane v = 0 a point lies. Only points on the plane itself need it told.
/// `both` is uncut tissue on the plane: the mean of the two sides.
enum class Side : int { left = -1, both = 0, right = 1 };

/// The side that the sign of v tells; `both` on the plane itself.
inline Side side_of(double v) { return v < 0 ? Side::left : v > 0 ? Side::right : Side::both; }

/// The canonical cut of a case: from (start, 0, 0) along u, `depth` below the skin, grown to `length` at the
/// last frame.
struct CanonicalCut {
  double start = 0, length = 0, depth = 0;
};

/// The report of the fit that goes with a field; errors are over the largest displacement from frame 0 unless
/// said.
struct FitReport {
  double relative_l2 = 0;           ///< sqrt(sum |error|^2 / sum |d|^2) over nodes and frames
  double node_error = 0;            ///< largest Euclidean error at any node and frame, as stored
  double spline_error = 0;          ///< the same for the spline alone (equal where no residual is stored)
  double gape_error = 0;            ///< largest error of the opening of a pair of nodes on the cut
  double false_gap = 0;             ///< largest opening across v = 0 at uncut nodes, where the truth is 0
  double largest_displacement = 0;  ///< mm, from frame 0
};

class Field {
 public:
  /// A 4D grid of control points: coefficients[((iu * V + iv) * W + iw) * T + it], mm. The v basis must have
  /// a knot of full multiplicity at 0.
  Field(BSplineBasis u, BSplineBasis v, BSplineBasis w, BSplineBasis t, std::vector<Vec3> coefficients,
        CanonicalCut cut);

  /// Displacement from the closed frame, mm. (u, v, w) is the stress-free position and t the length cut; all
  /// four are clamped to the domain. On v = 0 `side` chooses the lip; elsewhere it must not contradict v and
  /// is ignored.
  Vec3 displacement(const Vec3& uvw, Side side, double t) const;

  /// The displacement's history at one point: coefficients of a B-spline over t, one for each control point
  /// of basis t. evaluate() of them at t gives displacement(uvw, side, t), for a handful of multiply-adds.
  std::vector<Vec3> contract(const Vec3& uvw, Side side) const;

  const BSplineBasis& basis(int axis) const { return bases_[axis]; }  ///< u, v, w, t = 0 .. 3
  const std::vector<Vec3>& coefficients() const { return coefficients_; }
  const CanonicalCut& cut() const { return cut_; }
  double duration() const { return bases_[3].back(); }  ///< t of the last frame, mm

  std::map<std::string, double> parameters;  ///< of the case, by dotted name
  std::string case_hash;
  FitReport report;

 private:
  std::array<BSplineBasis, 4> bases_;
  std::vector<Vec3> coefficients_;
  CanonicalCut cut_;
};

/// Value at t of a history made by Field::contract.
Vec3 evaluate(const BSplineBasis& t_basis, std::span<const Vec3> history, double t);

}  // namespace cleft
