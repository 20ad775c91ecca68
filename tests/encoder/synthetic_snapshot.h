// Snapshots of nodes and displacements of a test's choice.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "encoder/encode.h"
#include "encoder/series.h"
#include "tests/support/temporary_folder.h"

namespace cleft {

/// Displacement of the node at p; `side` is told on the cut alone.
using Motion = std::function<Vec3(const Vec3& p, Side side, double t)>;

inline const std::vector<double> eight_times = {0, 2, 3, 4, 5, 6, 7, 8};

inline void silent(const std::string&) {}

/// What a snapshot needs beside its points: a cut along u from -4 to 4, `depth` deep, its tip at t - 4. All
/// points on v = 0 strictly within it are doubled, and open once the tip has passed.
inline Snapshot cut_in(std::vector<Vec3> points, const std::vector<double>& times, double depth = 1.5) {
  Snapshot s;
  s.points = std::move(points), s.times = times;
  s.cut_start = -4, s.cut_length = 8, s.cut_depth = depth;
  const std::size_t single = s.points.size();
  std::vector<std::size_t> doubled;
  for (std::size_t n = 0; n < single; ++n)
    if (const Vec3 p = s.points[n]; p.y == 0 && std::abs(p.x) < 4 && p.z > -depth) doubled.push_back(n);
  std::stable_sort(doubled.begin(), doubled.end(),
                   [&](std::size_t a, std::size_t b) { return s.points[a].x < s.points[b].x; });
  for (const std::size_t n : doubled) {
    s.pairs.push_back({static_cast<int>(n), static_cast<int>(s.points.size())});
    s.points.push_back(s.points[n]);
  }
  for (const double t : times) {
    s.position.push_back(t - 4);
    int open = 0;
    for (const auto& [left, right] : s.pairs)
      if (s.points[left].x < t - 4) ++open;
    s.released.push_back(open);
  }
  s.cell_offsets = {0};
  s.smallest_gap = s.residual_equilibrium = s.residual_closure = times;
  s.case_hash = "0123456789abcdef";
  s.parameters.set("skin.thickness", 1.5);
  s.parameters.set("cut.frames", "column");
  return s;
}

/// Points of a grid over 12 x 10 x 2.5 mm, skin on top, none of which has v = 0 where `nv` is odd.
inline std::vector<Vec3> grid(int nu = 12, int nv = 10, int nw = 5) {
  std::vector<Vec3> points;
  for (int i = 0; i <= nu; ++i)
    for (int j = 0; j <= nv; ++j)
      for (int k = 0; k <= nw; ++k)
        points.push_back({12. * i / nu - 6, 2 * j == nv ? 0. : 10. * j / nv - 5, 2.5 * k / nw - 2.5});
  return points;
}

/// A snapshot file and its series.
class SyntheticSnapshot {
 public:
  SyntheticSnapshot(Snapshot snapshot, const Motion& motion) : s_(std::move(snapshot)) {
    SnapshotWriter writer(folder_ / "case.h5", s_);
    const std::vector<Sample> samples = samples_of(s_);
    for (std::size_t j = 0; j < s_.frames(); ++j) {
      std::vector<Vec3> d;
      for (const Sample& sample : samples) d.push_back(motion(sample.uvw, sample.side, s_.times[j]));
      writer.write_frames(j, d);
    }
    writer.finish(s_);
    reader_.emplace(folder_ / "case.h5");
  }
  /// On the usual grid.
  explicit SyntheticSnapshot(const Motion& motion, const std::vector<double>& times = eight_times)
      : SyntheticSnapshot(cut_in(grid(), times), motion) {}

  const SnapshotReader& reader() const { return *reader_; }
  Series series() const { return Series(*reader_); }

 private:
  TemporaryFolder folder_;
  Snapshot s_;
  std::optional<SnapshotReader> reader_;
};

inline Encoded encoded_on(const Series& series, const std::string& parametrization, const Rung& rung) {
  EncodeOptions options;
  options.parametrization = parametrization, options.rung = rung;
  return encode(series, options, silent);
}

inline Encoded encoded_within(const Series& series, double tolerance,
                              const std::string& parametrization = "tip") {
  EncodeOptions options;
  options.parametrization = parametrization, options.tolerance = tolerance;
  return encode(series, options, silent);
}

/// -1 left and 1 right of the cut, 0 on uncut tissue.
inline double sign_of(const Vec3& p, Side side) {
  return side == Side::left || p.y < 0 ? -1 : side == Side::right || p.y > 0 ? 1 : 0;
}

inline Vec3 cubic(const Vec3& p, double t) {
  return {t * (1 + p.x * p.y * p.z / 50), t * t * (p.x - p.y * p.y * p.y / 90),
          t * t * t * (p.z * p.z - p.x * p.x * p.y) / 300};
}

/// A cut that opens behind its tip: lips part by an ellipse along u, shut at the bottom, and the tissue
/// beside them follows.
inline Vec3 opening(const Vec3& p, Side side, double t) {
  const double behind = std::max(0., (p.x + 4) * (t - 4 - p.x)), open = std::max(0., 1 + p.z / 1.5);
  const double gape = 0.2 * std::sqrt(behind) * open, away = std::exp(-std::abs(p.y) / 2);
  return {0.02 * t * std::sin(0.4 * p.x + 0.3 * p.y), sign_of(p, side) * gape * away,
          -0.1 * gape * away * (1 + 0.2 * p.x)};
}

inline double largest_coefficient(const Field& field) {
  double largest = 0;  // NaN stays
  for (const Vec3& c : field.coefficients())
    for (int axis = 0; axis < 3; ++axis)
      if (!(std::abs(c[axis]) <= largest)) largest = std::abs(c[axis]);
  return largest;
}

}  // namespace cleft
