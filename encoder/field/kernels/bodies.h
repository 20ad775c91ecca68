// The kernels' bodies, compiled once for each width. The including file defines
//   CLEFT_TARGET          the attribute of the machine the functions are for
//   CLEFT_WIDE            whether it has registers of four doubles
// and gets KERNELS, the table's initialiser.
#include <algorithm>
#include <limits>

namespace cleft {

namespace {

#define CLEFT_INLINE CLEFT_TARGET inline __attribute__((always_inline))

#include "encoder/field/kernels/four.h"

CLEFT_INLINE void store(const Four& sum, Vec3& out) {
  alignas(32) double d[4];
  four(d) = sum;
  out = {d[0], d[1], d[2]};
}

using Spans = std::array<const BasisSpan*, 4>;

/// The spans of a place, on all four axes at once.
CLEFT_INLINE void find(const Axes& axes, const BasisPlace& place, Spans& spans) {
  alignas(32) double bucket[4];
  four(bucket) =
      clamped((four(place.at) - four(axes.front)) * four(axes.scale), splat(0), four(axes.last_bucket));
  for (int a = 0; a < 4; ++a) {
    int span = axes.starts[a][static_cast<int>(bucket[a])];
    for (int k = 0; k < axes.ends_a_bucket; ++k) span += place.at[a] >= axes.ends[a][span];
    spans[a] = axes.spans[a] + span;
  }
  if (place.at[1] == axes.break_at) spans[1] = axes.at_break[static_cast<int>(place.side) + 1];
}

/// Weights on the first `count` axes, and on request their derivatives by the parameter.
template <int count, bool with_slopes>
CLEFT_INLINE void weigh(const Spans& spans, const BasisPlace& place, double (&weight)[4][4],
                        double (*slope)[4], int (&first)[4]) {
  const Four begin = make(spans[0]->begin, spans[1]->begin, spans[2]->begin, spans[3]->begin),
             length = make(spans[0]->length, spans[1]->length, spans[2]->length, spans[3]->length);
  const Four s = (four(place.at) - begin) / length, r = 1. - s;
  alignas(32) double b[4][4], db[4][4];  // [m][axis]
  four(b[0]) = r * r * r;
  four(b[1]) = 3. * r * r * s;
  four(b[2]) = 3. * r * s * s;
  four(b[3]) = s * s * s;
  if constexpr (with_slopes) {
    const Four q = 3. / length;
    four(db[0]) = -(q * r * r);
    four(db[1]) = q * r * (r - 2. * s);
    four(db[2]) = q * s * (2. * r - s);
    four(db[3]) = q * s * s;
  }
  for (int axis = 0; axis < count; ++axis) {
    const auto& share = spans[axis]->share;
    first[axis] = spans[axis]->first;
    four(weight[axis]) = b[0][axis] * four(share[0]) + b[1][axis] * four(share[1]) +
                         b[2][axis] * four(share[2]) + b[3][axis] * four(share[3]);
    if constexpr (with_slopes)
      four(slope[axis]) = db[0][axis] * four(share[0]) + db[1][axis] * four(share[1]) +
                          db[2][axis] * four(share[2]) + db[3][axis] * four(share[3]);
  }
}

CLEFT_INLINE std::ptrdiff_t offset_of(const std::array<std::ptrdiff_t, 3>& stride, const int (&first)[4]) {
  return first[0] * stride[0] + first[1] * stride[1] + first[2] * stride[2] + 4 * first[3];
}

CLEFT_TARGET void locate(const Axes& axes, const BasisPlace& place, Stencil& out) {
  Spans spans;
  find(axes, place, spans);
  weigh<4, false>(spans, place, out.weight, nullptr, out.first);
}

/// The 64 control points of a stencil at its t: [i][j][k], four doubles each.
CLEFT_INLINE void collapse_stencil(const Stencil& s, const ControlGrid& grid, double* out) {
  const double* corner = grid.data() + offset_of(grid.stride, s.first);
  const auto& t = s.weight[3];
  const Four t0 = splat(t[0]), t1 = splat(t[1]), t2 = splat(t[2]), t3 = splat(t[3]);
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) {
      const double* row = corner + i * grid.stride[0] + j * grid.stride[1];
      for (int k = 0; k < 4; ++k, row += grid.stride[2], out += 4)
        four(out) = (t0 * four(row) + t1 * four(row + 4)) + (t2 * four(row + 8) + t3 * four(row + 12));
    }
}

/// 64 terms. Weights that are 0 add nothing, whatever the order: the limits at a break agree to the last bit
/// where they meet.
CLEFT_INLINE void sum(const double (&weight)[4][4], const double* points, std::ptrdiff_t along,
                      std::ptrdiff_t across, Vec3& out) {
  const auto& [u, v, w, unused] = weight;
  Four even[4]{}, odd[4]{};
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) {
      const double* row = points + i * along + j * across;
      const Four both = splat(u[i] * v[j]);
      for (int k = 0; k < 4; ++k) (j % 2 ? odd : even)[k] += both * four(row + 4 * k);
    }
  store((w[0] * (even[0] + odd[0]) + w[1] * (even[1] + odd[1])) +
            (w[2] * (even[2] + odd[2]) + w[3] * (even[3] + odd[3])),
        out);
}

/// Of many places the spans first, then the weights, then the sums: each step waits for nothing but loads.
constexpr std::size_t places_at_once = 32;

template <int count>
CLEFT_INLINE void locate_all(const Axes& axes, const BasisPlace* places, std::size_t n, Stencil* stencils) {
  Spans spans[places_at_once];
  for (std::size_t i = 0; i < n; ++i) find(axes, places[i], spans[i]);
  for (std::size_t i = 0; i < n; ++i)
    weigh<count, false>(spans[i], places[i], stencils[i].weight, nullptr, stencils[i].first);
}

/// In two steps, over t and in space: neighbours in a list mostly share the first.
CLEFT_TARGET void values(const Axes& axes, const ControlGrid& grid, const BasisPlace* places, std::size_t n,
                         Vec3* out) {
  Stencil stencils[places_at_once];
  alignas(64) double points[256];
  std::array<int, 4> cell{-1, -1, -1, -1};
  double t = 0;
  for (std::size_t begin = 0; begin < n; begin += places_at_once) {
    const std::size_t count = std::min(places_at_once, n - begin);
    locate_all<4>(axes, places + begin, count, stencils);
    for (std::size_t i = 0; i < count; ++i) {
      const Stencil& s = stencils[i];
      const std::array<int, 4> now{s.first[0], s.first[1], s.first[2], s.first[3]};
      if (now != cell || !(places[begin + i].at[3] == t)) {
        collapse_stencil(s, grid, points);
        cell = now, t = places[begin + i].at[3];
      }
      sum(s.weight, points, 64, 16, out[begin + i]);
    }
  }
}

CLEFT_TARGET void gradient(const Axes& axes, const ControlGrid& grid, const BasisPlace& place,
                           Gradient& out) {
  alignas(32) double weight[4][4], slope[4][4];
  int first[4];
  Spans spans;
  find(axes, place, spans);
  weigh<4, true>(spans, place, weight, slope, first);
  const double* points = grid.data() + offset_of(grid.stride, first);
  const auto& [u, v, w, t] = weight;
  const auto& [du, dv, dw, dt] = slope;
  Four value{}, by[4]{};
  for (int i = 0; i < 4; ++i) {
    Four value_i{}, by_across{}, by_height{}, by_time{};
    for (int j = 0; j < 4; ++j) {
      const double* row = points + i * grid.stride[0] + j * grid.stride[1];
      Four value_j{}, by_height_j{}, by_time_j{};
      for (int k = 0; k < 4; ++k, row += grid.stride[2]) {
        const Four at_t =
            t[0] * four(row) + t[1] * four(row + 4) + t[2] * four(row + 8) + t[3] * four(row + 12);
        value_j += w[k] * at_t;
        by_height_j += dw[k] * at_t;
        by_time_j += w[k] * (dt[0] * four(row) + dt[1] * four(row + 4) + dt[2] * four(row + 8) +
                             dt[3] * four(row + 12));
      }
      value_i += v[j] * value_j;
      by_across += dv[j] * value_j;
      by_height += v[j] * by_height_j;
      by_time += v[j] * by_time_j;
    }
    value += u[i] * value_i;
    by[0] += du[i] * value_i;
    by[1] += u[i] * by_across;
    by[2] += u[i] * by_height;
    by[3] += u[i] * by_time;
  }
  four(out.value) = value;
  for (int axis = 0; axis < 4; ++axis) four(out.by[axis]) = by[axis];
}

CLEFT_TARGET void combine(const Rows& rows, std::ptrdiff_t length, double* out) {
  std::ptrdiff_t at = 0;
  for (; at + 16 <= length; at += 16) {
    Four sums[4]{};
    for (int r = 0; r < rows.count; ++r)
      for (int l = 0; l < 4; ++l) sums[l] += rows.weight[r] * loose(rows.row[r] + at + 4 * l);
    for (int l = 0; l < 4; ++l) put(out + at + 4 * l, sums[l]);
  }
  for (; at < length; at += 4) {
    Four rest{};
    for (int r = 0; r < rows.count; ++r) rest += rows.weight[r] * loose(rows.row[r] + at);
    put(out + at, rest);
  }
}

CLEFT_TARGET void collapse(const double* points, std::ptrdiff_t row, const double (&weight)[4],
                           std::size_t count, double* out) {
  for (std::size_t i = 0; i < count; ++i, points += row, out += 4)
    put(out, (weight[0] * loose(points) + weight[1] * loose(points + 4)) +
                 (weight[2] * loose(points + 8) + weight[3] * loose(points + 12)));
}

CLEFT_TARGET void values_in_space(const Axes& axes, const double* points, const std::ptrdiff_t (&stride)[2],
                                  const BasisPlace* places, std::size_t n, Vec3* out) {
  Stencil stencils[places_at_once];
  for (std::size_t begin = 0; begin < n; begin += places_at_once) {
    const std::size_t count = std::min(places_at_once, n - begin);
    locate_all<3>(axes, places + begin, count, stencils);
    for (std::size_t i = 0; i < count; ++i) {
      const auto& [first_u, first_v, first_w, unused] = stencils[i].first;
      sum(stencils[i].weight, points + first_u * stride[0] + first_v * stride[1] + 4 * first_w, stride[0],
          stride[1], out[begin + i]);
    }
  }
}

CLEFT_TARGET void replay(const PieceBlock* blocks, const double* offsets, const int* vertices,
                         std::size_t front, std::size_t back, double time, double begin, double length,
                         const Vec3* rest, Vec3* out) {
  const Four zero = splat(0), one = splat(1);
  const double inverse = 1 / length;
  Four b0 = zero, b1 = zero, b2 = zero, b3 = zero;
  double same = std::numeric_limits<double>::quiet_NaN();  // the offset of four vertices with these weights
  for (std::size_t at = front; at < back;) {
    const std::size_t block = at / 4, end = std::min(back, 4 * block + 4);
    const double* offset = offsets + 4 * block;
    if (offset[0] != same || offset[3] != same) {
      const Four s = clamped((splat(time - begin) + loose(offset)) * splat(inverse), zero, one), r = 1. - s;
      b0 = r * r * r, b1 = 3. * r * r * s, b2 = 3. * r * s * s, b3 = s * s * s;
      same = offset[0] == offset[3] ? offset[0] : std::numeric_limits<double>::quiet_NaN();
    }
    const auto& c = blocks[block].control;
    alignas(32) double d[3][4];
    for (int i = 0; i < 3; ++i)
      four(d[i]) = (b0 * loose(c[0][i]) + b1 * loose(c[1][i])) + (b2 * loose(c[2][i]) + b3 * loose(c[3][i]));
    for (; at < end; ++at) {
      const Vec3& from = rest[vertices[at]];
      const std::size_t lane = at % 4;
      out[vertices[at]] = {from.x + d[0][lane], from.y + d[1][lane], from.z + d[2][lane]};
    }
  }
}

}  // namespace

#define KERNELS \
  { values, gradient, locate, combine, collapse, values_in_space, replay }

}  // namespace cleft
