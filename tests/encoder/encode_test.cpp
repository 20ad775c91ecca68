// What encode() promises of the field, its report, and special snapshots.
#include "encoder/encode.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "encoder/series_fit.h"
#include "tests/encoder/synthetic_snapshot.h"

namespace cleft {

TEST(Encode, ReproducesACubic) {
  const SyntheticSnapshot data([](const Vec3& p, Side, double t) { return cubic(p, t); });
  const Series series = data.series();
  const Field field = encoded_on(series, "fixed", {.along = 5, .across = 2, .above = 3, .time = 2}).field;
  EXPECT_LT(field.report.node_error, 1e-6);
  EXPECT_LT(field.report.false_gap, 1e-6);
}

TEST(Encode, KeepsAJumpAcrossTheCutSharp) {
  // Frame 0 is closed; then the sides move apart by a polynomial of their own. Uncut plane nodes are given
  // the mean, 0.
  const SyntheticSnapshot data([](const Vec3& p, Side side, double t) {
    return Vec3{0, sign_of(p, side) * t * (1 + p.x * p.x / 40), 0};
  });
  const Series series = data.series();
  const auto parametrization = make_parametrization("fixed", series.geometry);
  const SeriesFit fit(series, parametrization,
                      bases_of({.along = 5, .across = 2, .above = 3, .time = 2}, *parametrization, 8));
  const Field field = fit.field(fit.control_points());
  // Away from the plane's uncut nodes, which contradict the jump, the two sides are fitted apart.
  const Vec3 left = field.displacement({0, -4, -0.2}, Side::both, 8),
             right = field.displacement({0, 4, -0.2}, Side::both, 8);
  EXPECT_NEAR(right.y - left.y, 16, 0.1);
  EXPECT_GT((field.displacement({0, 0, 0}, Side::right, 8) - field.displacement({0, 0, 0}, Side::left, 8)).y,
            8);
}

/// Two series on one mesh, and one on another mesh between them.
TEST(Encode, AFieldDoesNotDependOnTheMatricesThatWereKept) {
  const auto moved = [](double bend) {
    return [bend](const Vec3& p, Side side, double t) {
      return Vec3{0.1 * std::sin(bend * p.x) * t, sign_of(p, side) * t * (1 + bend * p.z),
                  bend * t * p.y / 9};
    };
  };
  const SyntheticSnapshot one(moved(0.2)), other(moved(0.7)), later(moved(0.7), {0, 1, 2, 3, 4, 5, 6, 9});
  const Series first = one.series(), second = other.series(), third = later.series();
  EncodeOptions options;
  options.tolerance = 0.02;
  const auto store = fit_store(first, options, 1e9);
  EXPECT_TRUE(store->serves(second));
  EXPECT_FALSE(store->serves(third)) << "its last frame is at another time";
  for (const Series* series : {&first, &second, &first}) {
    const Field alone = encode(*series, options, silent).field,
                kept = encode(*series, options, silent, store).field;
    EXPECT_EQ(kept.coefficients(), alone.coefficients());
    EXPECT_EQ(kept.report.condition, alone.report.condition);
  }
}

TEST(Encode, ReportsTheErrorsOfBruteForce) {
  for (const char* parametrization : {"fixed", "tip"}) {
    SCOPED_TRACE(parametrization);
    const SyntheticSnapshot data([](const Vec3& p, Side side, double t) {
      return 7 * Vec3{std::sin(3 * p.x) * t, sign_of(p, side) * t, 0};
    });
    const Field field = encoded_on(data.series(), parametrization, {.across = 1, .time = 1}).field;
    const Snapshot& s = data.reader().snapshot();
    const std::vector<Sample> samples = samples_of(s);
    double worst = 0, largest = 0, squared = 0, total = 0, gape = 0, gap = 0, of_frame = 0;
    for (std::size_t j = 0; j < s.frames(); ++j) {
      const auto d = data.reader().displacement(j);
      const auto jump = [&](const Vec3& p) {
        return field.displacement(p, Side::right, s.times[j]) - field.displacement(p, Side::left, s.times[j]);
      };
      double here = 0, most = 0;
      for (std::size_t n = 0; n < samples.size(); ++n) {
        const double error = norm(field.displacement(samples[n].uvw, samples[n].side, s.times[j]) - d[n]);
        here = std::max(here, error), most = std::max(most, norm(d[n]));
        squared += error * error, total += squared_norm(d[n]);
        if (samples[n].uvw.y == 0 && samples[n].side == Side::both)
          gap = std::max(gap, norm(jump(samples[n].uvw)));
      }
      worst = std::max(worst, here), largest = std::max(largest, most);
      if (most > 0) of_frame = std::max(of_frame, here / most);
      for (std::size_t p = 0; p < s.pairs.size(); ++p) {
        const double error = norm(jump(s.points[s.pairs[p][0]]) - (d[s.pairs[p][1]] - d[s.pairs[p][0]]));
        double& kind = static_cast<int>(p) < s.released[j] ? gape : gap;
        kind = std::max(kind, error);
      }
    }
    EXPECT_NEAR(field.report.spline_error, worst / largest, 1e-12);
    EXPECT_EQ(field.report.node_error, field.report.spline_error);
    EXPECT_NEAR(field.report.frame_error, of_frame, 1e-12);
    EXPECT_NEAR(field.report.relative_l2, std::sqrt(squared / total), 1e-12);
    EXPECT_NEAR(field.report.largest_displacement, largest, 1e-12 * largest);
    EXPECT_NEAR(field.report.gape_error, gape / largest, 1e-12);
    EXPECT_NEAR(field.report.false_gap, gap / largest, 1e-12);
    EXPECT_GT(field.report.gape_error, 0.01);
    EXPECT_GT(field.report.false_gap, 0.01);
  }
}

TEST(Encode, ClosedAtTimeZeroExactly) {
  const SyntheticSnapshot data(opening);
  for (const char* parametrization : {"fixed", "tip"}) {
    const Field field = encoded_within(data.series(), 0.05, parametrization).field;
    for (const Sample& sample : samples_of(data.reader().snapshot()))
      for (const Side side : {Side::left, Side::right})
        if (sample.uvw.y == 0 || side == sample.side) {
          ASSERT_EQ(field.displacement(sample.uvw, side, 0), Vec3{}) << parametrization;
        }
    EXPECT_EQ(field.displacement({0.123, 1.7, -0.3}, Side::both, 0), Vec3{}) << parametrization;
  }
}

TEST(Encode, CarriesTheCutAndStoresWhatItMeasures) {
  const SyntheticSnapshot data([](const Vec3& p, Side, double t) { return cubic(p, t); });
  const Field field = encoded_within(data.series(), 0.01, "fixed").field;
  EXPECT_EQ(field.cut().start, -4);
  EXPECT_EQ(field.cut().length, 8);
  EXPECT_EQ(field.cut().depth, 1.5);
  ASSERT_GT(field.quantum, 0);
  for (const Vec3& c : field.coefficients())
    for (int i = 0; i < 3; ++i)
      ASSERT_EQ(c[i], std::nearbyint(c[i] / field.quantum) * field.quantum) << "measured before rounding";
}

TEST(Encode, SidesOfDoubledNodesComeFromThePairs) {
  const SyntheticSnapshot data([](const Vec3&, Side, double) { return Vec3{}; });
  const std::vector<Sample> samples = samples_of(data.reader().snapshot());
  ASSERT_EQ(data.reader().snapshot().pairs.size(), 21u);
  for (const auto& [left, right] : data.reader().snapshot().pairs) {
    EXPECT_EQ(samples[left].side, Side::left);
    EXPECT_EQ(samples[right].side, Side::right);
  }
}

TEST(Encode, FewFramesGetFewControlPointsInTime) {
  const Motion motion = [](const Vec3& p, Side, double t) { return Vec3{t * p.y, t * t, 0}; };
  for (const char* parametrization : {"fixed", "tip"}) {
    const SyntheticSnapshot three(motion, {0, 2, 8}), two(motion, {0, 8});
    const Field of_three = encoded_on(three.series(), parametrization, {.time = 16}).field;
    EXPECT_EQ(of_three.basis(3).size(), 3);
    EXPECT_EQ(of_three.basis(3).degree(), 2);
    EXPECT_LT(of_three.report.node_error, 1e-6);
    const Field of_two = encoded_on(two.series(), parametrization, {.time = 16}).field;
    EXPECT_EQ(of_two.basis(3).size(), 2);
    EXPECT_EQ(of_two.basis(3).degree(), 1);
    EXPECT_LT(of_two.report.node_error, 1e-6) << parametrization;
    EXPECT_LE(encoded_within(two.series(), 1e-3, parametrization).field.report.node_error, 1e-3);
  }
}

TEST(Encode, NothingThatMovesIsNoError) {
  const SyntheticSnapshot data([](const Vec3& p, Side, double) { return p; });
  for (const char* parametrization : {"fixed", "tip"}) {
    const Encoded encoded = encoded_within(data.series(), 0.01, parametrization);
    EXPECT_EQ(encoded.field.report.largest_displacement, 0);
    EXPECT_EQ(encoded.field.report.node_error, 0);
    EXPECT_FALSE(encoded.residual);
    for (const Vec3& c : encoded.field.coefficients()) ASSERT_EQ(c, Vec3{});
  }
}

TEST(Encode, WithoutACutIsAPlainSpline) {
  Snapshot s = cut_in(grid(12, 9, 5), eight_times);  // no node on v = 0
  ASSERT_TRUE(s.pairs.empty());
  const SyntheticSnapshot data(s, [](const Vec3& p, Side, double t) { return cubic(p, t); });
  const Field field = encoded_within(data.series(), 1e-3).field;
  EXPECT_EQ(field.parametrization().name(), "fixed");
  EXPECT_EQ(field.cut().length, 0);
  for (int a = 0; a < 4; ++a)
    for (std::size_t i = 4; i + 5 < field.basis(a).knots().size(); ++i)
      EXPECT_LT(field.basis(a).knots()[i], field.basis(a).knots()[i + 1]) << "a break in axis " << a;
  EXPECT_LE(field.report.node_error, 1e-3);
  EXPECT_EQ(field.displacement({1, 0, -1}, Side::left, 4), field.displacement({1, 0, -1}, Side::right, 4));
}

}  // namespace cleft
