// Snapshots whose nodes are in space and know their coordinates of the cut.
#pragma once

#include <array>
#include <cmath>

#include "tests/encoder/synthetic_snapshot.h"

namespace cleft {

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

}  // namespace cleft
