// Snapshots whose nodes are in space and know their coordinates of the cut.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "tests/encoder/synthetic_snapshot.h"

namespace cleft {

namespace {

/// The usual grid, bent around a cylinder whose axis is along u, with a node beyond the patch of 12 x 10 mm.
struct BentSnapshot {
  static constexpr double radius = 12;
  TemporaryFolder folder;
  std::vector<Vec3> canonical;
  std::string file = folder / "case.h5";

  static std::array<Vec3, 3> frame(const Vec3& at) {
    const double a = at.y / radius;
    return {Vec3{1, 0, 0}, Vec3{0, std::cos(a), -std::sin(a)}, Vec3{0, std::sin(a), std::cos(a)}};
  }

  explicit BentSnapshot(const Motion& motion) {
    std::vector<Vec3> points = grid();
    points.insert(points.begin(), {9, 1, -1});
    Snapshot s = cut_in(points, eight_times);
    s.coordinates = true;
    s.parameters.set("patch.length", 12.), s.parameters.set("patch.width", 10.);
    const std::vector<Sample> samples = samples_of(s);
    canonical = s.points;
    std::vector<double> places, frames;
    for (Vec3& p : s.points) {
      const auto axes = frame(p);
      for (int i = 0; i < 3; ++i) places.push_back(p[i]);
      for (const Vec3& axis : axes)
        for (int i = 0; i < 3; ++i) frames.push_back(axis[i]);
      p = Vec3{p.x, 0, -radius} + (radius + p.z) * axes[2];
    }
    const SnapshotArray derivative{"displacement_per_skin.prestress_v", 3, true};
    SnapshotWriter writer(file, s, {{"canonical", 3, false}, {"frame", 9, false}, derivative});
    writer.write_array({"canonical", 3, false}, 0, places);
    writer.write_array({"frame", 9, false}, 0, frames);
    for (std::size_t j = 0; j < s.frames(); ++j) {
      std::vector<Vec3> d;
      for (std::size_t n = 0; n < samples.size(); ++n) {
        const Vec3 local = motion(canonical[n], samples[n].side, s.times[j]);
        const auto [u, v, w] = frame(canonical[n]);
        d.push_back(local.x * u + local.y * v + local.z * w);
      }
      writer.write_frames(j, d);
      writer.write_array(derivative, j, {&d.front().x, 3 * d.size()});
    }
    writer.finish(s);
  }
};

}  // namespace

TEST(Coordinates, ABentSeriesIsTheFlatOne) {
  const Motion motion = [](const Vec3& p, Side side, double t) {
    Vec3 d = opening(p, side, t);
    if (p.x > 6) d = {100, 100, 100};  // outside the patch
    return d;
  };
  const BentSnapshot bent(motion);
  const Series series{SnapshotReader(bent.file)};
  const Series flat = SyntheticSnapshot(motion).series();
  ASSERT_EQ(series.samples.size(), flat.samples.size());
  for (std::size_t n = 0; n < flat.samples.size(); ++n) {
    EXPECT_EQ(series.samples[n].uvw, flat.samples[n].uvw);
    EXPECT_EQ(series.samples[n].side, flat.samples[n].side);
  }
  EXPECT_EQ(series.pairs, flat.pairs);
  for (std::size_t j = 0; j < flat.frames.size(); ++j)
    EXPECT_LT((series.frames[j] - flat.frames[j]).cwiseAbs().maxCoeff(), 1e-12);
  ASSERT_EQ(series.derivatives.size(), 1u);
  EXPECT_LT((series.derivatives[0].frames.back() - flat.frames.back()).cwiseAbs().maxCoeff(), 1e-12);
  for (const int axis : {0, 1}) {
    EXPECT_EQ(series.geometry.domain[axis].front, axis == 0 ? -6 : -5);
    EXPECT_EQ(series.geometry.domain[axis].back, axis == 0 ? 6 : 5);
  }
}

}  // namespace cleft
