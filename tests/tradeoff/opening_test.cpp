// Openings that are known in closed form, at places between nodes and frames.
#include "tradeoff/opening.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "tests/support/temporary_folder.h"

namespace cleft {

namespace {

/// Half of the opening of a slit from 0 to t: the square root of the distances from both ends, times
/// `factor`.
double lip(double s, double t, double factor) { return s > 0 && s < t ? factor * std::sqrt(s * (t - s)) : 0; }

/// A cut of 12 mm, opened node after node; nodes stand so many mm apart.
std::string slit_file(const TemporaryFolder& folder, const std::string& name, double step, double factor,
                      double bend = 0) {
  Snapshot s;
  s.cut_start = -6, s.cut_length = 12, s.cut_depth = 1;
  const int inner = static_cast<int>(std::lround(12 / step)) - 1;
  for (int side = 0; side < 2; ++side)
    for (int i = 1; i <= inner; ++i) s.points.push_back({-6 + i * step, bend * i, 0});
  s.points.insert(s.points.end(), {{-6, -1, 0}, {6, -1, 0}, {0, 3, 0}});
  s.cell_types = {Snapshot::triangle}, s.cell_offsets = {0, 3};
  s.connectivity = {2 * inner, 2 * inner + 1, 2 * inner + 2};
  s.times = {0}, s.position = {-6 + step}, s.released = {0};
  for (int i = 1; i <= inner; ++i) {
    s.pairs.push_back({i - 1, inner + i - 1});
    s.times.push_back((i + 1) * step), s.position.push_back(-6 + (i + 1) * step), s.released.push_back(i);
  }
  s.smallest_gap.assign(s.times.size(), 0);
  s.residual_equilibrium = s.residual_closure = s.smallest_gap;
  const std::string path = folder / name;
  SnapshotWriter writer(path, s);
  for (std::size_t j = 0; j < s.times.size(); ++j) {
    std::vector<Vec3> d(s.points.size());
    for (int i = 0; i < inner; ++i) {
      const double half = lip((i + 1) * step, s.times[j], factor);
      d[i].y = -half, d[inner + i].y = half;
    }
    writer.write_frames(j, d);
  }
  writer.finish(s);
  return path;
}

TEST(Opening, IsExactForSlitsBetweenNodesAndFrames) {
  const TemporaryFolder folder;
  const Opening opening{SnapshotReader(slit_file(folder, "a.h5", 1, 0.2))};
  EXPECT_NEAR(opening.largest(), 0.4 * 6, 1e-12);
  for (double t = 2.0; t <= 12; t += 0.37)
    for (double s = 0; s <= 12; s += 0.21)
      EXPECT_NEAR(opening.at(s, t).y, 2 * lip(s, t, 0.2), 1e-12) << s << " " << t;
  EXPECT_EQ(opening.at(3, 0).y, 0);
}

TEST(Opening, ErrorIsTheDifferenceOverTheLargestOpeningWhateverTheMeshes) {
  const TemporaryFolder folder;
  const Opening coarse{SnapshotReader(slit_file(folder, "a.h5", 2, 0.19))},
      fine{SnapshotReader(slit_file(folder, "b.h5", 0.75, 0.2))};
  EXPECT_NEAR(opening_error(coarse, fine), 0.05, 2e-3);  // the fine one has no node just in the middle
  EXPECT_NEAR(opening_error(coarse, coarse), 0, 1e-14);
}

TEST(Opening, CurvedCutsAreRefused) {
  const TemporaryFolder folder;
  EXPECT_THROW(Opening{SnapshotReader(slit_file(folder, "a.h5", 1, 0.2, 0.1))}, InputError);
}

}  // namespace

}  // namespace cleft
