// The kernels' bodies, compiled once for each width. The including file defines
//   CLEFT_TARGET          the attribute of the machine the functions are for
//   CLEFT_MANY_REGISTERS  whether sixteen weights fit into registers beside the sums
// and gets KERNELS, the table's initialiser. Wide types are handed on by reference: machines of different
// widths pass them differently.
#include <algorithm>

namespace cleft {

namespace {

typedef double Four __attribute__((vector_size(32), may_alias));
typedef double LooseFour __attribute__((vector_size(32), aligned(8), may_alias));

#define CLEFT_INLINE CLEFT_TARGET inline __attribute__((always_inline))

CLEFT_INLINE const Four& four(const double* p) { return *reinterpret_cast<const Four*>(p); }
CLEFT_INLINE Four& four(double* p) { return *reinterpret_cast<Four*>(p); }
CLEFT_INLINE const LooseFour& loose(const double* p) { return *reinterpret_cast<const LooseFour*>(p); }
CLEFT_INLINE LooseFour& loose(double* p) { return *reinterpret_cast<LooseFour*>(p); }

CLEFT_INLINE void store(const Four& sum, Vec3& out) {
  alignas(32) double d[4];
  four(d) = sum;
  out = {d[0], d[1], d[2]};
}

/// Weights on each of `count` axes, and where asked for their derivatives by the parameter.
template <int count, bool with_slopes>
CLEFT_INLINE void weigh(const SpanTable* axes, const BasisPlace& place, double (&weight)[4][4],
                        double (*slope)[4], int (&first)[4]) {
  static_assert(count == 3 || count == 4);
  const BasisSpan* span[4] = {axes[0].spans() + axes[0].find(place.at[0], Limit::from_right),
                              axes[1].spans() + axes[1].find(place.at[1], place.side),
                              axes[2].spans() + axes[2].find(place.at[2], Limit::from_right), nullptr};
  span[3] = count == 3 ? span[2] : axes[3].spans() + axes[3].find(place.at[3], Limit::from_right);
  const Four begin{span[0]->begin, span[1]->begin, span[2]->begin, span[3]->begin},
      length{span[0]->length, span[1]->length, span[2]->length, span[3]->length};
  const Four s = (four(place.at) - begin) / length, r = 1 - s;
  alignas(32) double b[4][4], db[4][4];  // [m][axis]
  four(b[0]) = r * r * r;
  four(b[1]) = 3 * r * r * s;
  four(b[2]) = 3 * r * s * s;
  four(b[3]) = s * s * s;
  if constexpr (with_slopes) {
    const Four q = 3 / length;
    four(db[0]) = -q * r * r;
    four(db[1]) = q * r * (r - 2 * s);
    four(db[2]) = q * s * (2 * r - s);
    four(db[3]) = q * s * s;
  }
  for (int axis = 0; axis < count; ++axis) {
    const auto& share = span[axis]->share;
    first[axis] = span[axis]->first;
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

CLEFT_TARGET void locate(const SpanTable* axes, const BasisPlace& place, Stencil& out) {
  weigh<4, false>(axes, place, out.weight, nullptr, out.first);
}

/// 256 terms, four control points of a row of time at once. Weights that are 0 add nothing, whatever the
/// order: the limits at a break agree to the last bit where they meet.
CLEFT_INLINE void sum(const Stencil& s, const ControlGrid& grid, Vec3& out) {
  const double* points = grid.data() + offset_of(grid.stride, s.first);
  const auto& [u, v, w, t] = s.weight;
  Four along_t[4]{};
  if constexpr (CLEFT_MANY_REGISTERS) {
    Four weight[16];
    for (int j = 0; j < 4; ++j)
      for (int k = 0; k < 4; ++k) weight[4 * j + k] = (Four{} + v[j]) * (Four{} + w[k]);
    for (int i = 0; i < 4; ++i, points += grid.stride[0]) {
      Four even[4]{}, odd[4]{};
      for (int j = 0; j < 4; ++j) {
        const double* row = points + j * grid.stride[1];
        for (int k = 0; k < 4; ++k, row += grid.stride[2])
          for (int l = 0; l < 4; ++l) (k % 2 ? odd : even)[l] += weight[4 * j + k] * four(row + 4 * l);
      }
      for (int l = 0; l < 4; ++l) along_t[l] += u[i] * (even[l] + odd[l]);
    }
  } else {
    const Four w0 = Four{} + w[0], w1 = Four{} + w[1], w2 = Four{} + w[2], w3 = Four{} + w[3];
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) {
        const double *row0 = points + i * grid.stride[0] + j * grid.stride[1], *row1 = row0 + grid.stride[2],
                     *row2 = row1 + grid.stride[2], *row3 = row2 + grid.stride[2];
        const Four weight = Four{} + u[i] * v[j];
        for (int l = 0; l < 16; l += 4)
          along_t[l / 4] += weight * (w0 * four(row0 + l) + w1 * four(row1 + l) + w2 * four(row2 + l) +
                                      w3 * four(row3 + l));
      }
  }
  store((t[0] * along_t[0] + t[1] * along_t[1]) + (t[2] * along_t[2] + t[3] * along_t[3]), out);
}

/// Stencils of many places first, then their sums: so the next place's weights do not wait for this one's
/// sum.
constexpr std::size_t places_at_once = 16;

CLEFT_TARGET void values(const SpanTable* axes, const ControlGrid& grid, const BasisPlace* places,
                         std::size_t n, Vec3* out) {
  Stencil stencils[places_at_once];
  for (std::size_t begin = 0; begin < n; begin += places_at_once) {
    const std::size_t count = std::min(places_at_once, n - begin);
    for (std::size_t i = 0; i < count; ++i)
      weigh<4, false>(axes, places[begin + i], stencils[i].weight, nullptr, stencils[i].first);
    for (std::size_t i = 0; i < count; ++i) sum(stencils[i], grid, out[begin + i]);
  }
}

CLEFT_TARGET void gradient(const SpanTable* axes, const ControlGrid& grid, const BasisPlace& place,
                           Gradient& out) {
  alignas(32) double weight[4][4], slope[4][4];
  int first[4];
  weigh<4, true>(axes, place, weight, slope, first);
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
    for (int l = 0; l < 4; ++l) loose(out + at + 4 * l) = sums[l];
  }
  for (; at < length; at += 4) {
    Four rest{};
    for (int r = 0; r < rows.count; ++r) rest += rows.weight[r] * loose(rows.row[r] + at);
    loose(out + at) = rest;
  }
}

CLEFT_TARGET void collapse(const double* points, std::ptrdiff_t row, const double (&weight)[4],
                           std::size_t count, double* out) {
  for (std::size_t i = 0; i < count; ++i, points += row, out += 4)
    loose(out) = (weight[0] * loose(points) + weight[1] * loose(points + 4)) +
                 (weight[2] * loose(points + 8) + weight[3] * loose(points + 12));
}

CLEFT_TARGET void values_in_space(const SpanTable* axes, const double* points,
                                  const std::ptrdiff_t (&stride)[2], const BasisPlace* places, std::size_t n,
                                  Vec3* out) {
  for (std::size_t p = 0; p < n; ++p) {
    alignas(32) double weight[4][4];
    int first[4];
    weigh<3, false>(axes, places[p], weight, nullptr, first);
    const double* corner = points + first[0] * stride[0] + first[1] * stride[1] + 4 * first[2];
    const auto& [u, v, w, unused] = weight;
    Four even[4]{}, odd[4]{};
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) {
        const double* row = corner + i * stride[0] + j * stride[1];
        const Four both = Four{} + u[i] * v[j];
        for (int k = 0; k < 4; ++k) (i % 2 ? odd : even)[k] += both * four(row + 4 * k);
      }
    store((w[0] * (even[0] + odd[0]) + w[1] * (even[1] + odd[1])) +
              (w[2] * (even[2] + odd[2]) + w[3] * (even[3] + odd[3])),
          out[p]);
  }
}

CLEFT_TARGET void replay(const PieceBlock* blocks, const double* offsets, const int* vertices,
                         std::size_t front, std::size_t back, double time, double begin, double length,
                         const Vec3* rest, Vec3* out) {
  const Four zero{}, one = zero + 1;
  const double inverse = 1 / length;
  for (std::size_t at = front; at < back;) {
    const std::size_t block = at / 4, end = std::min(back, 4 * block + 4);
    const auto& c = blocks[block].control;
    Four s = ((time - begin) + loose(offsets + 4 * block)) * inverse;
    s = s < zero ? zero : s > one ? one : s;
    const Four r = one - s, b0 = r * r * r, b1 = 3 * r * r * s, b2 = 3 * r * s * s, b3 = s * s * s;
    alignas(32) double d[3][4];
    for (int i = 0; i < 3; ++i)
      four(d[i]) = b0 * loose(c[0][i]) + b1 * loose(c[1][i]) + b2 * loose(c[2][i]) + b3 * loose(c[3][i]);
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
