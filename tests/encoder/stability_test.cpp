// Data that leave the fit ill-posed: what holds all the same.
#include <gtest/gtest.h>

#include <random>

#include "base/error.h"
#include "encoder/series_fit.h"
#include "tests/encoder/synthetic_snapshot.h"
#include "tests/support/stability_row.h"

namespace cleft {

namespace {

/// Changes slowly, over 10 mm or so; of size 1.
Vec3 smooth(const Vec3& p, double t) {
  return t / 8 * Vec3{std::sin(0.3 * p.x + 0.2), std::cos(0.25 * p.y) * 0.8, std::sin(0.2 * (p.x + p.z))};
}
const Motion smoothly = [](const Vec3& p, Side, double t) { return smooth(p, t); };

double error_at(const Field& field, const Vec3& p, double t) {
  return norm(field.displacement(p, p.y < 0 ? Side::left : Side::right, t) - smooth(p, t));
}

/// Never a NaN, and no coefficient beyond twice the data.
void expect_bounded(const Encoded& encoded) {
  const Field& field = encoded.field;
  EXPECT_TRUE(std::isfinite(field.report.node_error) && std::isfinite(field.report.condition));
  EXPECT_LE(largest_coefficient(field), 2 * field.report.largest_displacement);
}

std::vector<Vec3> cloud(int count) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> u(-6, 6), v(-5, 5), w(-2.5, 0);
  std::vector<Vec3> points;
  for (int n = 0; n < count; ++n) points.push_back({u(random), v(random), w(random)});
  return points;
}

}  // namespace

TEST(Stability, FewerNodesThanCoefficients) {
  std::vector<Vec3> points = cloud(2744 - 14);
  for (int i = -3; i <= 3; ++i) points.push_back({1. * i, 0, 0});  // 7 pairs
  const SyntheticSnapshot data(cut_in(points, eight_times), smoothly);
  const Encoded encoded =
      encoded_on(data.series(), "fixed", {.along = 17, .across = 7, .above = 17, .time = 1});
  ASSERT_EQ(data.reader().snapshot().points.size(), 2744u);
  ASSERT_EQ(encoded.field.coefficients().size(), 8000u * 4);
  expect_bounded(encoded);
  double worst = 0;
  std::mt19937 random(8);
  std::uniform_real_distribution<double> u(-6, 6), v(-5, 5), w(-2.5, 0);
  for (int n = 0; n < 4000; ++n) {
    const Vec3 p{u(random), v(random), w(random)};
    worst = std::max(worst, error_at(encoded.field, p, 8));
  }
  EXPECT_LT(worst, 0.1 * encoded.field.report.largest_displacement);
  record_limit(
      {.method = "least squares of the encoder",
       .limit = "fewer nodes than unknowns",
       .shown = "2744 nodes, 8000 control points in space: between the nodes the spline is off by " +
                rounded(worst / encoded.field.report.largest_displacement) +
                " of the largest displacement, and no coefficient exceeds " +
                rounded(largest_coefficient(encoded.field) / encoded.field.report.largest_displacement) +
                " times it",
       .noticed = "where a tolerance is given: only rungs that the nodes determine are tried",
       .then = "the regularisation determines what the data leave free"});
}

TEST(Stability, HoleInTheCloud) {
  const auto in_hole = [](const Vec3& p, double radius) { return std::hypot(p.x - 2, p.y - 2) < radius; };
  std::vector<Vec3> points;
  for (const Vec3& p : grid(24, 20, 5))
    if (!in_hole(p, 1.2)) points.push_back(p);
  const SyntheticSnapshot data(cut_in(points, eight_times), smoothly);
  const auto expect_no_worse_inside = [&](const Encoded& encoded) {
    expect_bounded(encoded);
    double inside = 0, beside = 0;
    for (double x = -0.5; x <= 4.5; x += 0.1)
      for (double y = 0.05; y <= 4.5; y += 0.1)
        for (double z = -2.4; z <= 0; z += 0.3) {
          const Vec3 p{x, y, z};
          double& kind = in_hole(p, 1.2) ? inside : beside;
          kind = std::max(kind, error_at(encoded.field, p, 8));
        }
    EXPECT_LT(inside, 2 * beside);
  };
  const Series series = data.series();
  // Of knots that are given, too. With fewer in time what follows the tip errs by up to 3 times as much in
  // the hole as next to it, by 3 % and less: there the knots' own limit is met, not the data's.
  expect_no_worse_inside(encoded_on(series, "fixed", {2, 8, 2, 5, 2, 1, 2}));
  expect_no_worse_inside(encoded_on(series, "tip", {2, 12, 2, 7, 2, 2, 4}));
  for (const char* parametrization : {"fixed", "tip"})
    for (const double tolerance : {0.05, 0.005}) {
      SCOPED_TRACE(std::string(parametrization) + ", " + std::to_string(tolerance));
      expect_no_worse_inside(encoded_within(series, tolerance, parametrization));
    }
}

TEST(Stability, SingleNodeInASpan) {
  // Of the 1.5 mm from 3 to 4.5, a whole span of the fixed basis, one node is left.
  std::vector<Vec3> points;
  for (const Vec3& p : grid(24, 20, 5))
    if (p.x <= 3 || p.x >= 4.5 || (p.x == 4 && p.y == 1 && p.z == -1)) points.push_back(p);
  const SyntheticSnapshot data(cut_in(points, eight_times), smoothly);
  for (const char* parametrization : {"fixed", "tip"}) {
    const Encoded encoded = encoded_on(data.series(), parametrization, {2, 8, 2, 3, 2, 1, 2});
    expect_bounded(encoded);
    double worst = 0, beside = 0;
    for (double x = 1; x <= 6; x += 0.1)
      for (double y = -5; y <= 5; y += 0.3)
        for (double z = -2.5; z <= 0; z += 0.5) {
          double& kind = 3 < x && x < 4.5 ? worst : beside;
          kind = std::max(kind, error_at(encoded.field, {x, y, z}, 8));
        }
    EXPECT_LT(worst, 0.1 * encoded.field.report.largest_displacement);
    EXPECT_LT(beside, 0.01 * encoded.field.report.largest_displacement);
  }
}

TEST(Stability, DuplicateNodes) {
  std::vector<Vec3> points = grid();
  const std::vector<Vec3> single = points;
  for (int copy = 0; copy < 3; ++copy)
    for (const Vec3& p : single)
      if (p.x > 0 && p.y != 0) points.push_back(p);
  const SyntheticSnapshot data(cut_in(points, eight_times), opening);
  for (const char* parametrization : {"fixed", "tip"}) {
    expect_bounded(encoded_on(data.series(), parametrization, {1, 3, 2, 3, 2, 1, 2}));
    const Encoded within = encoded_within(data.series(), 0.01, parametrization);
    expect_bounded(within);
    EXPECT_LE(within.field.report.node_error, 0.01);
  }
}

TEST(Stability, AllNodesInAPlane) {
  std::vector<Vec3> points;
  for (const Vec3& p : grid(24, 20, 1))
    if (p.z == 0) points.push_back(p);
  const SyntheticSnapshot data(cut_in(points, eight_times), opening);
  for (const char* parametrization : {"fixed", "tip"}) {
    const Encoded within = encoded_within(data.series(), 0.01, parametrization);
    expect_bounded(within);
    EXPECT_LE(within.field.report.node_error, 0.01);
  }
}

TEST(Stability, OneFrameIsRefused) {
  const SyntheticSnapshot one(smoothly, {0});
  try {
    one.series();
    FAIL() << "taken";
  } catch (const InputError& e) {
    EXPECT_STREQ(e.what(), "the snapshot holds 1 frame; a time series needs at least 2");
  }
}

TEST(Stability, ErrorsDoNotDependOnTheScale) {
  for (const char* parametrization : {"fixed", "tip"}) {
    std::vector<FitReport> reports;
    for (const double scale : {1., 1e-12, 1e12}) {
      const SyntheticSnapshot data(
          [=](const Vec3& p, Side side, double t) { return scale * opening(p, side, t); });
      const Encoded encoded = encoded_within(data.series(), 0.01, parametrization);
      reports.push_back(encoded.field.report);
      expect_bounded(encoded);
    }
    for (const FitReport& r : reports) {
      EXPECT_LE(r.node_error, 0.01);
      EXPECT_NEAR(r.relative_l2 / reports[0].relative_l2, 1, 0.01);
    }
  }
}

TEST(Stability, NotANumberIsRefusedByFrameAndNode) {
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    const SyntheticSnapshot data([=](const Vec3& p, Side, double t) {
      return t == 4 && p == Vec3{-6, -5, -1} ? Vec3{0, bad, 0} : smooth(p, t);
    });
    try {
      data.series();
      FAIL() << "taken";
    } catch (const InputError& e) {
      EXPECT_NE(std::string(e.what()).find("frame 3, node 3"), std::string::npos) << e.what();
    }
  }
}

TEST(Stability, CoincidentKnots) {
  const SyntheticSnapshot data(cut_in(grid(24, 20, 5), eight_times), smoothly);
  const Series series = data.series();
  const auto parametrization = make_parametrization("fixed", series.geometry);
  for (const double apart : {0., 1e-12, 1e-6, 1e-4, 1e-2}) {
    std::array<BSplineBasis, 4> bases =
        bases_of({.along = 3, .across = 2, .above = 1, .time = 2}, *parametrization, 8);
    bases[0] = BSplineBasis(3, {-6, -6, -6, -6, -1, 2, 2 + apart, 2 + 2 * apart, 2 + 3 * apart, 6, 6, 6, 6});
    const SeriesFit fit(series, parametrization, bases);
    const Field field = fit.field(fit.control_points());
    EXPECT_LE(largest_coefficient(field), 2 * series.largest_displacement) << apart;
    EXPECT_LT(fit.misfit(0).largest, 0.01 * series.largest_displacement) << apart;
  }
}

}  // namespace cleft
