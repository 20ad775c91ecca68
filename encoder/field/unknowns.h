// The unknowns among a field's control points, which its file stores as integers; the others follow from
// them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "encoder/field/coefficient_code.h"
#include "encoder/field/control_ties.h"
#include "encoder/field/field.h"

namespace cleft {

/// The ties of a field's control points: those of its parametrisation.
ControlTies ties_of(const std::string& parametrization, const std::array<BSplineBasis, 4>& bases);

/// The places of the unknowns on the grid along, across and in height.
CoefficientGrid places_of(const ControlTies& ties, const std::array<BSplineBasis, 4>& bases);

/// All control points, mm, in the order of Field, of the unknowns' values, mm, in the order of
/// encode_coefficients(). If there is one slice less than control points in t, the first control points are
/// 0.
std::vector<Vec3> control_points(const ControlTies& ties, const std::array<BSplineBasis, 4>& bases,
                                 std::span<const double> values);
/// The same of values that are integers times the quantum, mm.
std::vector<Vec3> control_points(const ControlTies& ties, const std::array<BSplineBasis, 4>& bases,
                                 std::span<const std::int64_t> values, double quantum);

/// Integers times the quantum.
std::vector<double> multiples(std::span<const std::int64_t> values, double quantum);

/// The unknowns' values of a field over `unit`, in the order of encode_coefficients(), and their slices in t:
/// without the first if that is 0 everywhere.
struct Unknowns {
  int slices = 0;
  std::vector<double> values;
};
Unknowns unknowns_of(const Field& field, const CoefficientGrid& places, double unit);
/// The same of any control points on these bases.
Unknowns unknowns_of(std::span<const Vec3> points, const BSplineBasis& time, const CoefficientGrid& places,
                     double unit);

/// The field with unknowns that are multiples of `quantum`, none moved by more than `farthest` quanta (0.5 to
/// 1: the further, the fewer bytes).
Field quantised(const Field& field, double quantum, double farthest);
/// The same of any control points on these bases.
std::vector<Vec3> quantised(std::span<const Vec3> points, const ControlTies& ties,
                            const std::array<BSplineBasis, 4>& bases, double quantum, double farthest);

}  // namespace cleft
