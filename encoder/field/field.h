// The discontinuous free-form deformation (DFFD): a cubic B-spline over (u, v, w, t) with a C^-1 break across
// v = 0. Paper, sections 3.2 and 3.3. Lengths in mm; u along the cut, v across it (left < 0 < right), w
// height (skin 0, below < 0).
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/vec3.h"
#include "encoder/field/bspline.h"
#include "encoder/field/history.h"
#include "encoder/field/parametrization.h"

namespace cleft {

/// On which side of the cut plane v = 0 a point lies. Only points on the plane itself need it told.
/// `both` is uncut tissue on the plane: the mean of the two sides.
enum class Side : int { left = -1, both = 0, right = 1 };

/// The side that the sign of v tells; `both` on the plane itself.
inline Side side_of(double v) { return v < 0 ? Side::left : v > 0 ? Side::right : Side::both; }

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
  /// A 4D grid of control points: coefficients[((i * V + j) * W + k) * T + l], mm, over the parameters along,
  /// across, height and time of the parametrisation.
  Field(std::shared_ptr<const Parametrization> parametrization, std::array<BSplineBasis, 4> bases,
        std::vector<Vec3> coefficients);
  /// The same over (u, v, w, t) themselves; the bases' ends are the domain.
  Field(BSplineBasis u, BSplineBasis v, BSplineBasis w, BSplineBasis t, std::vector<Vec3> coefficients,
        CanonicalCut cut);

  /// Displacement from the closed frame, mm. (u, v, w) is the stress-free position and t the length cut; all
  /// four are clamped to the domain. On v = 0 `side` chooses the lip; elsewhere it must not contradict v and
  /// is ignored.
  Vec3 displacement(const Vec3& uvw, Side side, double t) const;

  /// The displacement's history at one point. Exact to rounding where the parametrisation does not move with
  /// t; else pieces break where the tip passes, and are halved until values between agree within `tolerance`
  /// mm.
  void contract(const Vec3& uvw, Side side, double tolerance, History& out) const;
  /// A tolerance for contract(), mm, that adds a tenth to the error of the fit.
  double contraction_tolerance() const;

  const Parametrization& parametrization() const { return *parametrization_; }
  std::shared_ptr<const Parametrization> shared_parametrization() const { return parametrization_; }
  const BSplineBasis& basis(int axis) const {
    return bases_[axis];
  }  ///< along, across, height, time = 0 .. 3
  const std::vector<Vec3>& coefficients() const { return coefficients_; }
  const CanonicalCut& cut() const { return parametrization_->geometry().cut; }
  const Interval& domain(int axis) const {
    return parametrization_->domain()[axis];
  }                                                   ///< u, v, w, t = 0 .. 3
  double duration() const { return domain(3).back; }  ///< t of the last frame

  std::map<std::string, double> parameters;  ///< of the case, by dotted name
  std::string case_hash;
  FitReport report;
  double quantum = 0;  ///< mm: unknowns are whole multiples of it, and stored as such; 0: as 32-bit floats

 private:
  std::shared_ptr<const Parametrization> parametrization_;
  std::array<BSplineBasis, 4> bases_;
  std::vector<Vec3> coefficients_;
};

}  // namespace cleft
