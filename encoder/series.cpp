#include "encoder/series.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/text.h"

namespace cleft {

namespace {

FieldGeometry geometry_of(const Snapshot& s) {
  FieldGeometry g;
  for (int axis = 0; axis < 3; ++axis) {
    const auto [least, greatest] = std::minmax_element(
        s.points.begin(), s.points.end(), [=](const Vec3& a, const Vec3& b) { return a[axis] < b[axis]; });
    g.domain[axis] = {(*least)[axis], (*greatest)[axis]};
    // A body without extent along an axis is the same everywhere along it.
    if (g.domain[axis].front == g.domain[axis].back) g.domain[axis].front -= 1, g.domain[axis].back += 1;
  }
  g.domain[3] = {s.times.front(), s.times.back()};
  g.cut = {s.cut_start, s.pairs.empty() ? 0 : s.cut_length, s.cut_depth};
  if (g.cut.length > 0 && !(g.domain[1].front < 0 && g.domain[1].back > 0))
    throw InputError("the nodes reach from v = " + shortest(g.domain[1].front) + " to " +
                     shortest(g.domain[1].back) + " mm: the cut plane v = 0 does not divide them");
  // The tip stands at `position`; frame 0 is closed, and then it grows with the blade.
  for (std::size_t j = 0; j < s.times.size(); ++j) {
    const double at = std::clamp(s.position[j], g.domain[0].front, g.domain[0].back);
    g.tip.times.push_back(s.times[j]), g.tip.positions.push_back(at);
  }
  // What lies on a straight line needs no place of its own.
  TipPath few;
  for (std::size_t j = 0; j < g.tip.times.size(); ++j) {
    const bool end = j == 0 || j + 1 == g.tip.times.size();
    if (!end) {
      const double part = (g.tip.times[j] - few.times.back()) / (g.tip.times[j + 1] - few.times.back());
      const double straight = few.positions.back() + part * (g.tip.positions[j + 1] - few.positions.back());
      if (std::abs(straight - g.tip.positions[j]) < 1e-9 * (g.domain[0].back - g.domain[0].front)) continue;
    }
    few.times.push_back(g.tip.times[j]), few.positions.push_back(g.tip.positions[j]);
  }
  g.tip = few;
  return g;
}

void check_cut(const Snapshot& s) {
  for (const auto& [left, right] : s.pairs) {
    const Vec3& at = s.points[static_cast<std::size_t>(left)];
    if (std::abs(at.y) > 1e-6 * s.cut_length)
      throw InputError("the cut leaves the plane v = 0 (node " + std::to_string(left) +
                       " at v = " + shortest(at.y) +
                       " mm): a field has its break there; cut.radius, cut.tilt, cut.count and "
                       "cut.branch make snapshots to measure against, not to encode");
  }
}

}  // namespace

Series::Series(const SnapshotReader& reader) {
  const Snapshot& s = reader.snapshot();
  if (s.frames() < 2)
    throw InputError("the snapshot holds " + std::to_string(s.frames()) +
                     " frame; a time series needs at least 2");
  check_cut(s);
  times = s.times, samples = samples_of(s), geometry = geometry_of(s), pairs = s.pairs, released = s.released;
  const std::vector<Vec3> closed = reader.displacement(0);
  for (std::size_t j = 0; j < s.frames(); ++j) {
    const std::vector<Vec3> d = reader.displacement(j);
    Eigen::MatrixX3d& frame = frames.emplace_back(static_cast<Eigen::Index>(d.size()), 3);
    for (std::size_t n = 0; n < d.size(); ++n)
      for (int axis = 0; axis < 3; ++axis) {
        const double value = d[n][axis] - closed[n][axis];
        if (!std::isfinite(value))
          throw InputError("frame " + std::to_string(std::isfinite(closed[n][axis]) ? j : 0) + ", node " +
                           std::to_string(n) + ": the displacement " + "uvw"[axis] + " is " +
                           shortest(d[n][axis]) + "; a field can only stand for finite numbers");
        frame(static_cast<Eigen::Index>(n), axis) = value;
      }
    largest.push_back(frame.rowwise().norm().maxCoeff());
  }
  largest_displacement = *std::max_element(largest.begin(), largest.end());
}

}  // namespace cleft
