// The lips of a fit next to those of its data.
#include "encoder/lips.h"

#include <gtest/gtest.h>

#include <limits>

#include "encoder/measure.h"
#include "encoder/series_fit.h"
#include "tests/encoder/synthetic_snapshot.h"

namespace cleft {

namespace {

double opening_at(const Field& field, const Series& series, std::size_t pair, std::size_t frame) {
  const Vec3& uvw = series.samples[series.pairs[pair][0]].uvw;
  const double t = series.times[frame];
  return field.displacement(uvw, Side::right, t).y - field.displacement(uvw, Side::left, t).y;
}

/// Least of what is left between the lips' opening and the data's or 0, the lesser of both.
double least_rest(const Field& field, const Series& series) {
  double least = HUGE_VAL;
  for (std::size_t j = 1; j < series.times.size(); ++j)
    for (std::size_t p = 0; p < static_cast<std::size_t>(series.released[j]); ++p) {
      const auto [left, right] = series.pairs[p];
      const double of_data = series.frames[j](right, 1) - series.frames[j](left, 1);
      least = std::min(least, opening_at(field, series, p, j) - std::min(0., of_data));
    }
  return least;
}

/// Lips that stay closed over half their length; and lips that are pressed through each other in between.
Vec3 half_closed(const Vec3& p, Side side, double t) {
  const Vec3 d = opening(p, side, t);
  return {d.x, p.x < 0 ? 0 : d.y, d.z};
}
Vec3 crossing(const Vec3& p, Side side, double t) {
  const Vec3 d = opening(p, side, t);
  return {d.x, d.y * std::sin(3 * p.x + t), d.z};
}

Field fitted(const Series& series, const char* parametrization) {
  const auto made = make_parametrization(parametrization, series.geometry);
  const SeriesFit fit(series, made, bases_of({.along = 4, .above = 1, .time = 3}, *made, 8));
  return fit.field(fit.control_points());
}

}  // namespace

TEST(Lips, DoNotPassThroughEachOtherWhereTheDataDoNot) {
  for (const Motion& motion : {Motion(half_closed), Motion(crossing)})
    for (const char* parametrization : {"tip", "fixed"}) {
      const Series series = SyntheticSnapshot(motion).series();
      const Field before = fitted(series, parametrization);
      ASSERT_LT(least_rest(before, series), -1e-3) << "nothing to mend";
      for (const double margin : {1e-4, 1e-2}) {
        const Field field = with_lips_apart(before, series, margin, std::numeric_limits<double>::infinity());
        // Sweeps end where the last moved no bound by more than a thousandth of the margin.
        EXPECT_GT(least_rest(field, series), 0.9 * margin) << parametrization << " " << margin;
      }
    }
}

/// What is changed are the lips' own control points, on both sides as much, and no opening becomes less.
TEST(Lips, AreMovedApartAndNothingElseIs) {
  const Series series = SyntheticSnapshot(crossing).series();
  const Field before = fitted(series, "tip"),
              after = with_lips_apart(before, series, 1e-3, std::numeric_limits<double>::infinity());
  const int V = before.basis(1).size(), W = before.basis(2).size(), T = before.basis(3).size();
  int moved = 0;
  for (std::size_t n = 0; n < before.coefficients().size(); ++n) {
    const Vec3 by = after.coefficients()[n] - before.coefficients()[n];
    if (by == Vec3{}) continue;
    ++moved;
    const int j = static_cast<int>(n) / (W * T) % V;
    EXPECT_EQ(by.x, 0);
    EXPECT_EQ(by.z, 0);
    EXPECT_NE(static_cast<int>(n) % T, 0);
    ASSERT_TRUE(j == V / 2 - 1 || j == V / 2);
    const std::size_t twin =
        j == V / 2 ? n - static_cast<std::size_t>(W * T) : n + static_cast<std::size_t>(W * T);
    // To the rounding of control points of some millimetres.
    EXPECT_NEAR(by.y, before.coefficients()[twin].y - after.coefficients()[twin].y, 1e-15);
    EXPECT_EQ(by.y > 0, j == V / 2);
  }
  EXPECT_GT(moved, 0);
  const FitReport report = measure(after, series);
  EXPECT_EQ(report.overlap, 0);
  EXPECT_EQ(report.false_gap, 0) << "uncut tissue is tied as before";
}

/// The nearest such field: no other change of the same openings is shorter. For a single bound that is the
/// change along its factors, and missing over their norm is its length.
TEST(Lips, MoveAsLittleAsPossible) {
  const Series whole = SyntheticSnapshot(crossing).series();
  const Field before = fitted(whole, "fixed");
  Series series = whole;
  std::size_t worst = 0;
  const std::size_t frame = series.times.size() - 1;
  double least = 0;
  for (std::size_t p = 0; p < static_cast<std::size_t>(series.released[frame]); ++p) {
    const auto [left, right] = series.pairs[p];
    const double rest = opening_at(before, series, p, frame) -
                        std::min(0., series.frames[frame](right, 1) - series.frames[frame](left, 1));
    if (rest < least) least = rest, worst = p;
  }
  ASSERT_LT(least, -1e-3);
  series.pairs = {series.pairs[worst]};
  series.released.assign(series.released.size(), 0), series.released[frame] = 1;
  const Field after = with_lips_apart(before, series, 1e-6, std::numeric_limits<double>::infinity());
  const Vec3& uvw = series.samples[series.pairs[0][0]].uvw;
  double length = 0, factors = 0;
  for (std::size_t n = 0; n < before.coefficients().size(); ++n)
    length += squared_norm(after.coefficients()[n] - before.coefficients()[n]);
  for (const double along : before.basis(0).evaluate(uvw.x).value)
    for (const double height : before.basis(2).evaluate(uvw.z).value)
      for (const double time : before.basis(3).evaluate(series.times[frame]).value)
        factors += along * along * height * height * time * time;
  // Half the jump's change on either side.
  EXPECT_NEAR(std::sqrt(2 * length), (1e-6 - least) / std::sqrt(factors), 1e-9);
}

}  // namespace cleft
