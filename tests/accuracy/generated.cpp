#include "tests/accuracy/generated.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "encoder/samples.h"
#include "solver/snapshot/snapshot.h"

namespace cleft {

namespace {

constexpr std::uint8_t tetrahedron = 10, hexahedron = 12;  // VTK's cell types

/// A block of nodes, `across` by `deep` columns on both sides of v = 0.
struct Block {
  int along, across, deep;
  double edge;

  int node(int i, int j, int k) const { return (i * (across + 1) + j) * (deep + 1) + k; }
  std::vector<Vec3> points() const {
    std::vector<Vec3> list;
    for (int i = 0; i <= along; ++i)
      for (int j = 0; j <= across; ++j)
        for (int k = 0; k <= deep; ++k)
          list.push_back({(i - along / 2) * edge, (j - across / 2) * edge, (k - deep) * edge});
    return list;
  }
  /// Calls visit(j, corners in VTK's order of a hexahedron) for every cell.
  void for_each_cell(const std::function<void(int, const std::array<int, 8>&)>& visit) const {
    for (int i = 0; i < along; ++i)
      for (int j = 0; j < across; ++j)
        for (int k = 0; k < deep; ++k)
          visit(j,
                {node(i, j, k), node(i + 1, j, k), node(i + 1, j + 1, k), node(i, j + 1, k),
                 node(i, j, k + 1), node(i + 1, j, k + 1), node(i + 1, j + 1, k + 1), node(i, j + 1, k + 1)});
  }
};

void add_cell(Snapshot& s, std::uint8_t type, std::span<const int> corners) {
  if (s.cell_offsets.empty()) s.cell_offsets.push_back(0);
  s.cell_types.push_back(type);
  s.connectivity.insert(s.connectivity.end(), corners.begin(), corners.end());
  s.cell_offsets.push_back(static_cast<std::int64_t>(s.connectivity.size()));
}

SnapshotSource source(const std::string& break_plane) {
  return {"series.pvd", {}, {Vec3{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, 0, break_plane};
}

using Motion = std::function<Vec3(const Vec3& p, double side, double t)>;  // side: -1 left, 0 both, 1 right

void write(const std::string& path, Snapshot& s, const Motion& motion) {
  s.smallest_gap.assign(s.frames(), 0);
  SnapshotWriter writer(path, s);
  const std::vector<Sample> samples = samples_of(s);
  for (std::size_t j = 0; j < s.frames(); ++j) {
    std::vector<Vec3> d;
    for (const auto& [p, side] : samples)
      d.push_back(motion(p, side == Side::left ? -1 : side == Side::right ? 1 : 0, s.times[j]));
    writer.write_frames(j, d);
  }
  writer.finish(s);
}

}  // namespace

void write_imported(const std::string& path) {
  const Block block{24, 12, 6, 1.5};
  constexpr double start = -9, end = 9, depth = 6;
  Snapshot s;
  s.source = source("0,1,0,0"), s.cut_start = start, s.cut_length = end - start, s.cut_depth = depth;
  s.points = block.points();
  std::vector<int> right(s.points.size());  // of a node of v = 0: its twin on the right
  for (int i = 0; i <= block.along; ++i)
    for (int k = block.deep; k >= 0; --k) {
      const int left = block.node(i, block.across / 2, k);
      const Vec3 p = s.points[left];
      right[left] = left;
      if (p.x < start || p.x >= end || p.z <= -depth) continue;
      right[left] = static_cast<int>(s.points.size());
      s.pairs.push_back({left, right[left]});
      s.points.push_back(p);
    }
  block.for_each_cell([&](int j, std::array<int, 8> corners) {
    for (int& corner : corners)
      if (j >= block.across / 2 && s.points[corner].y == 0) corner = right[corner];
    add_cell(s, hexahedron, corners);
  });
  const auto tip = [&](double t) { return start + (end - start) * t * (2 - t); };
  for (int j = 0; j <= 12; ++j) {
    s.times.push_back(std::pow(j / 12., 1.3));
    const double at = tip(s.times.back());
    const auto open = [&](const auto& pair) { return s.points[pair[0]].x < at - 1e-9; };
    s.released.push_back(static_cast<int>(std::count_if(s.pairs.begin(), s.pairs.end(), open)));
    const std::size_t closed = s.released.back();
    s.position.push_back(closed < s.pairs.size() ? s.points[s.pairs[closed][0]].x : end);
  }
  // The lips part as the square root of the distance from start, tip and bottom; the rest follows more weakly
  // with the distance from the cut.
  write(path, s, [&](const Vec3& p, double side, double t) {
    const double behind = std::max(0., (p.x - start) * (tip(t) - p.x)), above = std::max(0., 1 + p.z / depth);
    const double gape = 0.1 * std::sqrt(behind * above) * std::exp(-std::abs(p.y) / 5);
    return Vec3{0.02 * t * p.y * std::exp(-p.x * p.x / 50), side * gape,
                0.3 * gape + 0.05 * t * std::sin(p.x / 6)};
  });
}

void write_uncut(const std::string& path) {
  const Block block{28, 10, 5, 1};
  Snapshot s;
  s.source = source("none"), s.points = block.points();
  block.for_each_cell([&](int, const std::array<int, 8>& c) {  // six around the diagonal from 0 to 6
    for (const auto& [a, b] : {std::pair{1, 2}, {2, 3}, {3, 7}, {7, 4}, {4, 5}, {5, 1}})
      add_cell(s, tetrahedron, std::array{c[0], c[a], c[b], c[6]});
  });
  for (int j = 0; j <= 15; ++j) s.times.push_back(0.1 * j);
  s.released.assign(s.frames(), 0), s.position.assign(s.frames(), 0);
  write(path, s, [](const Vec3& p, double, double t) {
    const double phase = p.x + 14 - 16 * t, pulse = std::exp(-phase * phase / 18);
    return Vec3{0.2 * pulse, 0.1 * pulse * std::sin(p.y / 4), 0.05 * t * std::cos(p.x / 8) * p.z / 5};
  });
}

}  // namespace cleft
