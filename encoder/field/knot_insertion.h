// Knots inserted into a field: the same function over finer bases, so that fields of different rungs of the
// ladder can be added up. Boehm's algorithm; Piegl and Tiller, The NURBS Book, A5.1.
#pragma once

#include <array>
#include <vector>

#include "base/vec3.h"
#include "encoder/field/bspline.h"

namespace cleft {

/// The least basis whose splines include those of both. Throws InputError where there is none: other degrees
/// or ends, or a break that only one of them has.
BSplineBasis common_basis(const BSplineBasis& a, const BSplineBasis& b);

/// From control points of a basis to those of one that has all its knots.
class KnotInsertion {
 public:
  /// Throws InputError where `to` lacks a knot of `from`.
  KnotInsertion(const BSplineBasis& from, const BSplineBasis& to);

  /// A new control point: of weight.size() old ones from number `first` on. Those that no knot is near are
  /// the old ones, to the last bit.
  struct Row {
    int first = 0;
    std::vector<double> weight;
  };
  const std::vector<Row>& rows() const { return rows_; }

 private:
  std::vector<Row> rows_;
};

/// Control points [((i * V + j) * W + k) * T + l] over finer bases.
std::vector<Vec3> insert_knots(const std::vector<Vec3>& coefficients, const std::array<BSplineBasis, 4>& from,
                               const std::array<BSplineBasis, 4>& to);

}  // namespace cleft
