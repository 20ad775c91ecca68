// The discontinuous free-form deformation (DFFD): a cubic B-spline over (u, v, w, t) with a C^-1 break across
// v = 0. Paper, sections 3.2 and 3.3. Lengths in mm; u along the cut, v across it (left < 0 < right), w
// height (skin 0, below < 0).
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/vec3.h"
#include "encoder/field/bspline.h"
#include "encoder/field/collapsed_field.h"
#include "encoder/field/control_grid.h"
#include "encoder/field/field_source.h"
#include "encoder/field/fit_report.h"
#include "encoder/field/history.h"
#include "encoder/field/kernels.h"
#include "encoder/field/parametrization.h"
#include "encoder/field/place.h"
#include "encoder/field/tissue_below_cut.h"
#include "params/parameters/recorded.h"

namespace cleft {

/// The displacement and its first derivatives, mm per mm.
struct Derivatives {
  Vec3 value, by_u, by_v, by_w, by_t;
};

class Field;

/// A further quantity over the field's bases, or its own: its value, not the difference from frame 0.
struct Quantity {
  std::string name;
  int components = 1;
  std::vector<double> coefficients;  ///< [(((i * V + j) * W + k) * T + l) * components + c]
  double largest =
      0;             ///< norm over the components (of six: of the tensor), at any node and frame of the data
  double error = 0;  ///< the same of the difference from them, as stored, over `scale`
  double spline_error = 0;  ///< the same for the spline alone (equal where no residual is stored)
  double quantum = 0;       ///< unknowns are whole multiples of it, and stored as such; 0: as 32-bit floats
  double scale = 0;  ///< what errors are relative to: `largest`, or the data's range where that is less
  double worst_node = 0, worst_time = 0;  ///< where spline_error is
  double between_nodes = 0;               ///< as FitReport has it, over `scale`
  std::optional<double> time = {};        ///< of what never changes: it is the spline at this time, always
  /// Where it has knots of its own: a field without a displacement on these, whose tip stands at its last
  /// place.
  std::shared_ptr<const Field> own = {};
};

/// The derivative of the displacement by a parameter of the case, over the field's bases, for interpolation
/// between cases.
struct ParameterDerivative {
  std::string parameter;             ///< dotted name
  std::vector<Vec3> control_points;  ///< as the field's, mm per the parameter's unit
  double quantum = 0;                ///< unknowns are whole multiples of it
  double largest = 0;                ///< Euclidean norm, at any node and frame of the data
  double error = 0;                  ///< the same of the difference from them, over `largest`
};

class Field {
 public:
  /// A 4D grid of control points: coefficients[((i * V + j) * W + k) * T + l], mm, over the parameters along,
  /// across, height and time of the parametrisation. Throws InputError if a degree is above 3.
  Field(std::shared_ptr<const Parametrization> parametrization, std::array<BSplineBasis, 4> bases,
        std::vector<Vec3> coefficients);
  /// The same over (u, v, w, t) themselves; the bases' ends are the domain.
  Field(BSplineBasis u, BSplineBasis v, BSplineBasis w, BSplineBasis t, std::vector<Vec3> coefficients,
        CanonicalCut cut);

  // The functions below allocate no memory, except for a History or CollapsedField that must grow.

  /// Displacement from the closed frame, mm. (u, v, w) is the stress-free position and t the length cut; all
  /// four are clamped to the domain. On v = 0 `side` selects the lip; elsewhere it is ignored and must not
  /// contradict v.
  Vec3 displacement(const Vec3& uvw, Side side, double t) const;
  /// The same at many places, which is the fastest way; `out` has one element for each.
  void displacements(std::span<const Place> places, std::span<Vec3> out) const;

  /// Displacement and derivatives inside the domain; those of the edge outside it. Where a derivative jumps
  /// (at the tip, at some knots) it is the limit from behind, in t that of the uncut side; for Side::both on
  /// v = 0 it is the mean of both sides.
  Derivatives derivatives(const Vec3& uvw, Side side, double t) const;

  /// The displacement's history at one point. Exact up to rounding if the parametrisation does not move with
  /// t. Else pieces break where the tip passes, and are as long as `tolerance`, mm, permits (or 1e-12 of the
  /// largest control point, if that is more); pieces meet at their ends.
  void contract(const Vec3& uvw, Side side, double tolerance, History& out) const;
  /// The same with further breaks at all `stops`, which are sorted, and no further than to t = `until`.
  void contract(const Vec3& uvw, Side side, double tolerance, std::span<const double> stops, History& out,
                double until = std::numeric_limits<double>::infinity()) const;
  /// A tolerance for contract(), mm, that adds a tenth to the error of the fit.
  double contraction_tolerance() const;
  /// The times of the knots of the basis in time, including the first and last t.
  std::vector<double> knot_times() const;

  /// The field at a fixed t, with 64 terms for each point. `out` refers to this field and must not outlive
  /// it.
  void collapse(double t, CollapsedField& out) const;

  /// Value of quantities[index], one number for each component.
  void quantity(std::size_t index, const Vec3& uvw, Side side, double t, std::span<double> out) const;

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

  /// Evaluates with the given kernel from now on; the default is the widest that the machine supports.
  void use(Kernel kernel) { kernels_ = &kernel_table(kernel); }

  double quantum = 0;  ///< mm: unknowns are whole multiples of it, and stored as such; 0: as 32-bit floats
  std::vector<Quantity> quantities;
  std::vector<ParameterDerivative> by_parameter;
  RecordedParameters parameters;  ///< of the case
  std::string case_hash;
  FitReport report;
  std::optional<Interpolation> interpolation;
  std::optional<FieldSource> source;
  std::optional<TissueBelow> tissue;  ///< of a body: below the middle of the cut

 private:
  friend class CollapsedField;

  BasisPlace mapped(const Vec3& uvw, Side side, double t) const;
  /// Of a quantity over these bases.
  void value(const Quantity& quantity, const Vec3& uvw, Side side, double t, std::span<double> out) const;
  void contract_fixed(const BasisPlace& place, double until, std::span<const double> stops,
                      History& out) const;
  void contract_moving(const Vec3& uvw, const BasisPlace& place, double until, double tolerance,
                       std::span<const double> stops, History& out) const;

  std::shared_ptr<const Parametrization> parametrization_;
  std::array<BSplineBasis, 4> bases_;
  std::vector<Vec3> coefficients_;
  std::shared_ptr<const Axes> axes_;  // one for all copies of the field: it is never changed
  ControlGrid grid_;
  const KernelTable* kernels_;
  double largest_coefficient_ = 0;
};

/// The field over whose bases a quantity is.
const Field& bases_of(const Quantity& quantity, const Field& field);

/// Bytes of the data, displacements (unless nothing moves) and further quantities, as 32-bit numbers.
double raw_bytes(const Field& field);

}  // namespace cleft
