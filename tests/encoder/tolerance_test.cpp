// The search over the ladder of knots: the tolerance is kept in the file, and what it costs.
#include <gtest/gtest.h>

#include <filesystem>

#include "encoder/field/file/field_file.h"
#include "encoder/ladder.h"
#include "tests/encoder/synthetic_snapshot.h"

namespace cleft {

namespace {

/// Largest error at any node and frame of what a file holds, over the largest displacement.
double node_error_of(const std::string& path, const SnapshotReader& reader) {
  const Field field = read_field(path);
  const std::optional<NodeResidual> residual = read_residual(path);
  const Snapshot& s = reader.snapshot();
  const std::vector<Sample> samples = samples_of(s);
  const std::vector<Vec3> closed = reader.displacement(0);
  double worst = 0, largest = 0;
  for (std::size_t j = 0; j < s.frames(); ++j) {
    const std::vector<Vec3> d = reader.displacement(j);
    for (std::size_t n = 0; n < d.size(); ++n) {
      Vec3 found = field.displacement(samples[n].uvw, samples[n].side, s.times[j]);
      if (residual && j > 0)
        for (std::size_t c = 0; c < 3; ++c)
          found[static_cast<int>(c)] +=
              residual->quantum * residual->values[(n * 3 + c) * (s.frames() - 1) + j - 1];
      worst = std::max(worst, norm(found - (d[n] - closed[n])));
      largest = std::max(largest, norm(d[n] - closed[n]));
    }
  }
  return worst / largest;
}

}  // namespace

class Tolerance : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(, Tolerance, testing::Values("tip", "fixed"),
                         [](const auto& of) { return of.param; });

TEST_P(Tolerance, IsKeptAtEveryNodeAndFrameOfTheFile) {
  // What frame 0 has is no part of the field.
  const SyntheticSnapshot data([](const Vec3& p, Side side, double t) {
    return opening(p, side, t) + Vec3{0.3 * p.x, 1, 0};
  });
  const Series series = data.series();
  const TemporaryFolder folder;
  bool with_residual = false;
  for (const double tolerance : {0.05, 0.01, 1e-3, 1e-5}) {
    const Encoded encoded = encoded_within(series, tolerance, GetParam());
    write_field(folder / "case.dffd", encoded);
    const double found = node_error_of(folder / "case.dffd", data.reader());
    EXPECT_LE(found, tolerance);
    EXPECT_GT(found, tolerance / 20) << "more than was asked for";
    EXPECT_NEAR(encoded.field.report.node_error, found, 1e-12) << tolerance;
    EXPECT_EQ(encoded.residual.has_value(), encoded.field.report.spline_error > tolerance) << tolerance;
    EXPECT_LE(largest_coefficient(encoded.field), 2 * series.largest_displacement) << tolerance;
    with_residual = with_residual || encoded.residual;
    std::filesystem::remove(folder / "case.dffd");
  }
  EXPECT_TRUE(with_residual);
}

TEST_P(Tolerance, TighterOnesDoNotCostFewerBytes) {
  const Series series = SyntheticSnapshot(opening).series();
  const TemporaryFolder folder;
  for (const double loosest : {0.1, 0.05}) {
    std::uintmax_t before = 0;
    for (double tolerance = loosest; tolerance > 2e-5; tolerance /= 10) {
      const Encoded encoded = encoded_within(series, tolerance, GetParam());
      const std::string path = folder / std::to_string(tolerance);
      write_field(path, encoded);
      EXPECT_GE(std::filesystem::file_size(path), before) << tolerance;
      before = std::filesystem::file_size(path);
    }
  }
}

TEST(CloseKnots, AreNested) {
  const FieldGeometry geometry{{{{-6, 6}, {-5, 4}, {-2.5, 0}, {0, 8}}}, {-4, 8, 1.5}, {{0, 8}, {-4, 4}}};
  const auto parametrization = make_parametrization("front", geometry);
  for (const bool bends : {false, true}) {
    const std::vector<Rung> rungs = close_rungs_of({.bends = bends});
    for (std::size_t i = 0; i < rungs.size(); ++i) {
      EXPECT_TRUE(rungs[i].close);
      const auto bases = bases_of(rungs[i], *parametrization, 21),
                 fewer = bases_of(rungs[i > 0 ? i - 1 : 0], *parametrization, 21);
      for (std::size_t axis = 0; axis < 4; ++axis) {
        const auto &few = fewer[axis].knots(), &many = bases[axis].knots();
        EXPECT_TRUE(std::includes(many.begin(), many.end(), few.begin(), few.end()))
            << i << ", axis " << axis;
      }
    }
  }
}

TEST_P(Tolerance, RungsAreSortedAndNested) {
  FieldGeometry within{{{{-6, 6}, {-5, 4}, {-2.5, 0}, {0, 8}}}, {-4, 8, 1.5}, {{0, 8}, {-4, 4}}};
  FieldGeometry through = within, uncut = within;
  through.cut = {-6, 12, 2.5}, through.tip = {{0, 8}, {6, 6}};
  uncut.cut.length = 0;
  for (const FieldGeometry& geometry : {within, through, uncut}) {
    if (GetParam() == "tip" && geometry.cut.length == 0) continue;
    const auto parametrization = make_parametrization(GetParam(), geometry);
    const std::vector<Rung> rungs = ladder_of(*parametrization);
    ASSERT_GT(rungs.size(), 10u);
    for (const int frames : {2, 3, 8, 48}) {
      auto last = bases_of(rungs[0], *parametrization, frames);
      for (std::size_t i = 1; i < rungs.size(); ++i) {
        const auto next = bases_of(rungs[i], *parametrization, frames);
        int grown = 0;
        for (std::size_t axis = 0; axis < 4; ++axis) {
          const auto &few = last[axis].knots(), &many = next[axis].knots();
          ASSERT_TRUE(std::is_sorted(many.begin(), many.end()));
          EXPECT_TRUE(std::includes(many.begin(), many.end(), few.begin(), few.end()))
              << "rung " << i << ", axis " << axis;
          EXPECT_LE(next[axis].size(), axis == 3 ? frames : 1000);
          if (axis < 3) grown += next[axis].size() > last[axis].size() ? 1 : 0;
        }
        last = next;
      }
    }
    for (std::size_t i = 1; i < rungs.size(); ++i) {
      const Rung &few = rungs[i - 1], &many = rungs[i];
      EXPECT_FALSE(few == many);
      for (int Rung::*const part : {&Rung::before, &Rung::along, &Rung::after, &Rung::across, &Rung::above,
                                    &Rung::below, &Rung::time})
        EXPECT_LE(few.*part, many.*part);
    }
  }
}

}  // namespace cleft
