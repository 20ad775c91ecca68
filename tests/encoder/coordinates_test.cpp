// Snapshots whose nodes are in space and know their coordinates of the cut.
#include <gtest/gtest.h>

#include "tests/encoder/bent_snapshot.h"

namespace cleft {

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
