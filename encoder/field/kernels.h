// The sums of which a field consists, for several instruction sets, chosen at run time. All agree up to
// rounding.
#pragma once

#include <cstddef>
#include <vector>

#include "base/vec3.h"
#include "encoder/field/control_grid.h"
#include "encoder/field/place.h"
#include "encoder/field/span_table.h"

namespace cleft {

/// plain: portable code; avx2: with FMA; avx512: with F, VL and DQ.
enum class Kernel { plain, avx2, avx512 };

/// The kernels that this machine supports, the widest last.
const std::vector<Kernel>& available_kernels();
const char* name_of(Kernel kernel);

/// Weights of 4 x 4 x 4 x 4 neighbouring control points, which begin at `first` on each axis.
struct alignas(32) Stencil {
  double weight[4][4];  ///< [axis][i]
  int first[4];
};

/// A sum of rows: out[0 .. length) = sum over r < count of weight[r] * row[r][0 .. length). Rows need not be
/// aligned; `length` is a multiple of 4.
struct Rows {
  const double* row[64];
  double weight[64];
  int count = 0;
};

/// A value and its derivatives by along, across, height and time; x, y, z, 0 each.
struct alignas(32) Gradient {
  double value[4], by[4][4];
};

/// Many cubic pieces over one span of time: [m][component][vertex] in blocks of four vertices, by Bezier
/// controls m.
struct PieceBlock {
  double control[4][3][4];
};

struct KernelTable {
  /// Field at n places: 256 terms each.
  void (*values)(const Axes& axes, const ControlGrid& grid, const BasisPlace* places, std::size_t n,
                 Vec3* out);
  void (*gradient)(const Axes& axes, const ControlGrid& grid, const BasisPlace& place, Gradient& out);
  /// The weights alone, for the sums below.
  void (*locate)(const Axes& axes, const BasisPlace& place, Stencil& out);
  void (*combine)(const Rows& rows, std::ptrdiff_t length, double* out);
  /// Sums over time: out[i] = sum over l < 4 of weight[l] * points[i * row + 4 l ..], i < count: points of 4.
  void (*collapse)(const double* points, std::ptrdiff_t row, const double (&weight)[4], std::size_t count,
                   double* out);
  /// A grid without time, with strides of doubles along two axes and 4 on the third: 64 terms each.
  void (*values_in_space)(const Axes& axes, const double* points, const std::ptrdiff_t (&stride)[2],
                          const BasisPlace* places, std::size_t n, Vec3* out);
  /// Positions rest + d of vertices number front .. back - 1 of `blocks`, at s = (clamp(time + offset) -
  /// begin) / length of the piece.
  void (*replay)(const PieceBlock* blocks, const double* offsets, const int* vertices, std::size_t front,
                 std::size_t back, double time, double begin, double length, const Vec3* rest, Vec3* out);
};

const KernelTable& kernel_table(Kernel kernel);

}  // namespace cleft
