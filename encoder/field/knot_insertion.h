// Knots inserted into a field: the same function over finer bases, so that fields of different rungs of the
// ladder can be added up. Boehm's algorithm; Piegl and Tiller, The NURBS Book, A5.1.
#pragma once

#include <array>
#include <vector>

#include "base/vec3.h"
#include "encoder/field/bspline.h"

namespace cleft {

/// The least basis whose splines include those of both. Throws InputError if there is none: other degrees or
/// ends, or a break in only one of them.
BSplineBasis common_basis(const BSplineBasis& a, const BSplineBasis& b);

/// A sum of weight.size() neighbouring values, from number `first` on.
struct BandRow {
  int first = 0;
  std::vector<double> weight;
};

/// From control points of a basis to those of one that has all its knots: a row for each of the new ones.
/// Control points without a new knot near them are unchanged, bit for bit. Throws InputError if `to` lacks a
/// knot of `from`.
std::vector<BandRow> knot_insertion(const BSplineBasis& from, const BSplineBasis& to);

/// A tensor [((i * V + j) * W + k) * T + l] of the given sizes, multiplied on each axis by its rows; an axis
/// without rows is unchanged.
std::vector<Vec3> along_axes(const std::vector<Vec3>& tensor, std::array<std::size_t, 4> size,
                             const std::array<std::vector<BandRow>, 4>& rows);

/// Control points [((i * V + j) * W + k) * T + l] over finer bases.
std::vector<Vec3> insert_knots(const std::vector<Vec3>& coefficients, const std::array<BSplineBasis, 4>& from,
                               const std::array<BSplineBasis, 4>& to);

}  // namespace cleft
