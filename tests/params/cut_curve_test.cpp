// The curve of a cut against closed forms and against integration in small steps.
#include "params/cut_curve.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "params/meshed_cut.h"

namespace cleft {
namespace {

CutCurve curve(double curvature, double rate) {
  Parameters p;
  p.cut.curvature = curvature, p.cut.curvature_rate = rate;
  return CutCurve(p);
}

TEST(CutCurve, OfConstantCurvatureIsAnArcAndItsTangents) {
  for (const double k : {0.06, -0.02}) {
    const CutCurve arc = curve(k, 0);
    const double half = arc.half_length();
    EXPECT_EQ(half, meshed_cut(Parameters()).length / 2);
    for (const double u : {-40., -half, -3.3, 0., 7.1, half, 30.}) {
      const double inside = std::clamp(u, -half, half), beyond = u - inside, angle = k * inside;
      const CutCurve::Place at = arc(u);
      EXPECT_NEAR(at.direction, angle, 1e-13);
      EXPECT_NEAR(at.x, std::sin(angle) / k + beyond * std::cos(angle), 1e-12);
      EXPECT_NEAR(at.y, (1 - std::cos(angle)) / k + beyond * std::sin(angle), 1e-12);
    }
  }
  EXPECT_TRUE(curve(0, 0).is_straight());
  EXPECT_FALSE(curve(0, 1e-3).is_straight());
}

TEST(CutCurve, WhoseCurvatureChangesIsAClothoid) {
  constexpr double k = 0.01, rate = 0.005;
  const CutCurve clothoid = curve(k, rate);
  for (const double to : {-12., 5., 15.}) {
    constexpr int steps = 20000;
    double x = 0, y = 0;
    for (int i = 0; i < steps; ++i) {
      const double u = to * (i + 0.5) / steps, direction = k * u + rate * u * u / 2;
      x += to / steps * std::cos(direction), y += to / steps * std::sin(direction);
    }
    EXPECT_NEAR(clothoid(to).direction, k * to + rate * to * to / 2, 1e-13);
    EXPECT_NEAR(clothoid(to).x, x, 1e-7);
    EXPECT_NEAR(clothoid(to).y, y, 1e-7);
  }
}

TEST(CutCurve, APlaceIsSeenFromItsFeet) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> along(-40, 40), across(-30, 30);
  int several = 0;
  for (const auto& [k, rate] : {std::pair{0.06, 0.}, {0., 0.006}, {0.03, -0.004}, {0., 0.}}) {
    const CutCurve cut = curve(k, rate);
    for (int i = 0; i < 100; ++i) {
      const double u = along(random), v = across(random);
      const CutCurve::Place at = cut(u);
      const double x = at.x - v * std::sin(at.direction), y = at.y + v * std::cos(at.direction);
      const auto feet = cut.feet(x, y);
      several += feet.size() > 1;
      double nearest = 1e9;
      for (const auto& [s, d] : feet) {
        const CutCurve::Place foot = cut(s);
        EXPECT_NEAR(foot.x - d * std::sin(foot.direction), x, 1e-9);
        EXPECT_NEAR(foot.y + d * std::cos(foot.direction), y, 1e-9);
        nearest = std::min(nearest, std::hypot(s - u, d - v));
      }
      EXPECT_LT(nearest, 1e-8) << "where it was made from: " << k << ", " << rate << ": " << u << ", " << v;
      EXPECT_TRUE(std::is_sorted(feet.begin(), feet.end(), [](const auto& a, const auto& b) {
        return std::abs(a[1]) < std::abs(b[1]);
      }));
    }
  }
  EXPECT_GT(several, 50);
}

}  // namespace
}  // namespace cleft
