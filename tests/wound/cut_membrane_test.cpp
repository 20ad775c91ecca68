// Cuts in a membrane against closed forms.
#include "explorer/wound/cut_membrane.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

namespace cleft {

namespace {

constexpr double nu = 0.4, stiff = 1 / (1 - nu * nu), shear = 1 / (2 * (1 + nu));  // of a sheet with E = 1
constexpr int pieces = 120;

/// Corners at places of the plane that are a function of 0 to 1.
std::vector<Eigen::Vector2d> along(int count, const std::function<Eigen::Vector2d(double)>& place) {
  std::vector<Eigen::Vector2d> corners;
  for (int i = 0; i <= count; ++i) corners.push_back(place(double(i) / count));
  return corners;
}

/// How a straight cut from -half to half opens in its middle, under unit tension across it and unit shear;
/// turned by an angle.
std::array<double, 2> middle_openings(double reach, double half, double angle = 0) {
  const auto cut = along(pieces, [&](double part) -> Eigen::Vector2d {
    return half * (2 * part - 1) * Eigen::Vector2d(std::cos(angle), std::sin(angle));
  });
  Eigen::MatrixXd loads = Eigen::MatrixXd::Zero(2 * pieces, 2);
  for (int i = 0; i < pieces; ++i) loads(2 * i + 1, 0) = loads(2 * i, 1) = 1;
  const Eigen::MatrixXd opened = CutMembrane(reach, nu).openings(cut, loads);
  EXPECT_NEAR(opened(pieces, 0), 0, 1e-9 * half) << "a straight cut under tension does not slide";
  EXPECT_NEAR(opened(pieces + 1, 1), 0, 1e-9 * half);
  return {opened(pieces + 1, 0), opened(pieces, 1)};
}

}  // namespace

TEST(CutMembrane, WithoutSpringsACutOpensAsGriffiths) {
  for (const double angle : {0., 0.7, 2.5})
    for (const double opened : middle_openings(1e6, 15, angle)) EXPECT_NEAR(opened, 4 * 15, 0.01 * 4 * 15);
}

TEST(CutMembrane, ALongCutOpensAsAnEndlessOne) {
  // (lambda + 2 mu) u'' = k u beside it under tension, mu u'' = k u in shear.
  const double reach = 5, k = stiff / (reach * reach);
  const auto [tension, sheared] = middle_openings(reach, 30);
  EXPECT_NEAR(tension, 2 / std::sqrt(stiff * k), 0.01 * tension);
  EXPECT_NEAR(sheared, 2 / std::sqrt(shear * k), 0.01 * sheared);
}

TEST(CutMembrane, NearTheEndsOfAnArcItSlidesAndOpensAsItsStressIntensities) {
  // An arc of half an angle a, pulled alike in all directions: K_II / K_I = tan(a / 2) (Muskhelishvili).
  for (const double half_angle : {0.3, 0.8, 1.3}) {
    const auto cut = along(pieces, [&](double part) {
      const double a = half_angle * (2 * part - 1);
      return Eigen::Vector2d(20 * std::sin(a), 20 * (1 - std::cos(a)));
    });
    Eigen::MatrixXd load = Eigen::MatrixXd::Zero(2 * pieces, 1);
    for (int i = 0; i < pieces; ++i) load(2 * i + 1, 0) = 1;
    const Eigen::MatrixXd opened = CutMembrane(1e6, nu).openings(cut, load);
    // The ratio at the end, from those at two pieces next to it.
    const auto ratio = [&](int piece) { return std::abs(opened(2 * piece, 0) / opened(2 * piece + 1, 0)); };
    EXPECT_NEAR(1.5 * ratio(3) - 0.5 * ratio(10), std::tan(half_angle / 2), 0.04 * std::tan(half_angle / 2))
        << half_angle;
  }
}

TEST(CutMembrane, WorkOfOneLoadThroughTheOpeningOfAnotherIsMutual) {
  // Betti: of any path, with springs.
  const auto cut = along(40, [](double part) { return Eigen::Vector2d(30 * part, 5 * std::sin(10 * part)); });
  Eigen::MatrixXd loads(80, 2);
  for (int i = 0; i < 80; ++i) loads(i, 0) = std::sin(0.3 * i), loads(i, 1) = std::cos(0.17 * i * i);
  const Eigen::MatrixXd opened = CutMembrane(12, nu).openings(cut, loads);
  double one = 0, other = 0, own = 0;
  for (int i = 0; i < 40; ++i) {
    const double length = (cut[i + 1] - cut[i]).norm();
    for (int c = 0; c < 2; ++c) {
      one += length * loads(2 * i + c, 0) * opened(2 * i + c, 1);
      other += length * loads(2 * i + c, 1) * opened(2 * i + c, 0);
      own += length * loads(2 * i + c, 0) * opened(2 * i + c, 0);
    }
  }
  EXPECT_NEAR(one, other, 0.02 * own);
  EXPECT_GT(own, 0);
}

}  // namespace cleft
