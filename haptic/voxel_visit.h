// Triangles of a voxel, and voxels around a point, nearest first. Private to contact_query.cpp and
// surface_proxy.cpp.
#pragma once

#include <bit>
#include <limits>

#include "haptic/contact_query.h"

namespace cleft {

/// Squared distances from x to the eight slabs of voxels of a block, along one axis. Points outside the grid
/// are in its outermost voxels.
inline void squared_gaps(const ContactCells& cells, int axis, int block, double x, double* gap) {
  constexpr int side = ContactCells::side;
  for (int n = 0; n < side; ++n) {
    const int voxel = side * block + n;
    const double low = cells.low()[axis] + cells.cell() * voxel, high = low + cells.cell();
    double away = 0;
    if (x < low && voxel > 0) away = low - x;
    if (x > high && voxel + 1 < cells.size(axis)) away = x - high;
    gap[n] = away * away;
  }
}

/// The occupied voxels of a block within `wanted` of x: first the nearest, which lowers `wanted`, then
/// others.
template <class Visit>
void visit_block(const ContactCells& cells, const ContactCells::Block& block, const int at[3], const Vec3& x,
                 double& wanted, const Visit& visit) {
  constexpr int side = ContactCells::side;
  double gap[3][side];
  for (int axis = 0; axis < 3; ++axis) squared_gaps(cells, axis, at[axis], x[axis], gap[axis]);
  const double slack = 1e-9 * cells.cell(), farthest = (wanted + slack) * (wanted + slack);
  std::uint64_t rows = 0, columns = 0;  // bits of the voxels that are near along one axis
  for (int n = 0; n < side; ++n) {
    if (gap[1][n] <= farthest) rows |= std::uint64_t{0xff} << (side * n);
    if (gap[2][n] <= farthest) columns |= std::uint64_t{0x0101010101010101} << n;
  }
  const auto each = [&](const auto& do_with) {
    for (int i = 0; i < side; ++i) {
      if (gap[0][i] > (wanted + slack) * (wanted + slack)) continue;
      std::uint64_t left = block.occupied[i].load(std::memory_order_acquire) & rows & columns;
      for (; left; left &= left - 1) {
        const int bit = std::countr_zero(left), j = bit / side, k = bit % side;
        do_with(i, j, k, gap[0][i] + gap[1][j] + gap[2][k]);
      }
    }
  };
  double least = farthest;
  int first = -1;
  each([&](int i, int j, int k, double square) {
    if (square <= least) least = square, first = (i * side + j) * side + k;
  });
  if (first < 0) return;
  const auto meet = [&](int i, int j, int k) { wanted = std::min(wanted, visit(block.at(i, j, k))); };
  meet(first / (side * side), first / side % side, first % side);
  each([&](int i, int j, int k, double square) {
    if (square <= (wanted + slack) * (wanted + slack) && (i * side + j) * side + k != first) meet(i, j, k);
  });
}

/// The triangles of a list that `may` accepts. The cutting thread may have overwritten the data of the last
/// tick: the corners of all triangles are prefetched before the first is used.
template <class May, class Look>
void ContactReader::each_of(const CellList& list, const May& may, const Look& look) const {
  constexpr int most = 16;
  int ids[most];
  for (int n = 0, count = list.count(); n < count;) {
    int kept = 0;
    for (; n < count && kept < most; ++n) {
      const int id = list[n];
      if (id < 0) continue;
      const StoredTriangle& t = stored(id);
      if (!t.exists() || !may(t)) continue;
      for (const int v : t.triangle().vertex) __builtin_prefetch(&surface_.positions_[v]);
      ids[kept++] = id;
    }
    for (int k = 0; k < kept; ++k) {
      Corners corners;
      ContactTriangle t;
      corners_of(ids[k], corners, t);
      look(ids[k], t, corners);
    }
  }
}

/// Voxels around x, block by block in shells of growing distance. `visit` takes a list and returns the
/// distance beyond which the search ends.
template <class Visit>
void ContactReader::visit_voxels(const Vec3& x, double radius, const Visit& visit) const {
  constexpr int bits = ContactCells::bits;
  const double edge = cells_.cell() * ContactCells::side;
  int middle[3], low[3], high[3], farthest = 0;
  double inside = std::numeric_limits<double>::infinity();  // from x to the nearest wall of its block
  for (int k = 0; k < 3; ++k) {
    middle[k] = cells_.index(x[k], k) >> bits;
    low[k] = cells_.index(x[k] - radius, k) >> bits, high[k] = cells_.index(x[k] + radius, k) >> bits;
    farthest = std::max({farthest, middle[k] - low[k], high[k] - middle[k]});
    const double from_low = x[k] - cells_.low()[k] - edge * middle[k];
    inside = std::min(inside, std::max(0.0, std::min(from_low, edge - from_low)));
  }
  double wanted = radius;
  for (int shell = 0; shell <= farthest && (shell == 0 || inside + edge * (shell - 1) <= wanted); ++shell) {
    const auto clip = [&](int k, int sign) {
      return sign < 0 ? std::max(low[k], middle[k] - shell) : std::min(high[k], middle[k] + shell);
    };
    for (int i = clip(0, -1); i <= clip(0, 1); ++i)
      for (int j = clip(1, -1); j <= clip(1, 1); ++j) {
        const bool rim = std::abs(i - middle[0]) == shell || std::abs(j - middle[1]) == shell;
        for (int k = clip(2, -1); k <= clip(2, 1); ++k) {
          if (!rim && std::abs(k - middle[2]) != shell) {
            k = std::max(k, middle[2] + shell - 1);  // through to the shell's other side
            continue;
          }
          const int at[3] = {i, j, k};
          if (const auto* block = cells_.block_at(i, j, k)) visit_block(cells_, *block, at, x, wanted, visit);
        }
      }
  }
}

}  // namespace cleft
