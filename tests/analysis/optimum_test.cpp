#include "explorer/analysis/optimum.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace cleft {

namespace {

BoxProblem box(double from, double to, Eigen::Index d,
               const std::function<std::pair<double, double>(const Eigen::VectorXd&)>& of) {
  return {Eigen::VectorXd::Constant(d, from), Eigen::VectorXd::Constant(d, to),
          [of](const Eigen::MatrixXd& points) {
            AimAndExcess values{Eigen::VectorXd(points.cols()), Eigen::VectorXd(points.cols())};
            for (Eigen::Index j = 0; j < points.cols(); ++j)
              std::tie(values.aim[j], values.excess[j]) = of(points.col(j));
            return values;
          }};
}

}  // namespace

TEST(Optimum, OfALinearFunctionInABallIsOnItsSurface) {
  // The least of a . x with |x - c| <= r is at c - r a / |a|.
  const Eigen::Vector4d a(1, -2, 0.5, 3), c(0.2, -0.1, 0.3, 0);
  const Optimum found = least_in_box(
      box(-2, 2, 4, [&](const Eigen::VectorXd& x) { return std::pair(a.dot(x), (x - c).norm() - 1.2); }),
      Eigen::MatrixXd(4, 0));
  EXPECT_LE(found.excess, 0);
  EXPECT_NEAR(found.aim, a.dot(c) - 1.2 * a.norm(), 1e-5);
  EXPECT_LT((found.point - (c - 1.2 * a.normalized())).norm(), 0.005);  // the square root of the aim's
}

TEST(Optimum, LeavesLocalMinima) {
  // Rastrigin's function: 11^3 minima; the least one is 0 at the origin, which starts far from the members.
  const Optimum found = least_in_box(box(-5.12, 4.1, 3,
                                         [](const Eigen::VectorXd& x) {
                                           double sum = 30;
                                           for (const double v : x)
                                             sum += v * v - 10 * std::cos(2 * std::numbers::pi * v);
                                           return std::pair(sum, 0.);
                                         }),
                                     Eigen::MatrixXd(3, 0));
  EXPECT_NEAR(found.aim, 0, 1e-6);
  EXPECT_LT(found.point.norm(), 1e-4);
}

TEST(Optimum, BeginsAtWhatIsGivenAndReachesCorners) {
  const Optimum found =
      least_in_box(box(-3, 5, 6, [](const Eigen::VectorXd& x) { return std::pair(x.sum(), 0.); }),
                   Eigen::VectorXd::Constant(6, 4));
  EXPECT_EQ(found.point, Eigen::VectorXd::Constant(6, -3));
}

TEST(Optimum, ThatNoPointReachesIsTheNearest) {
  const Optimum found = least_in_box(
      box(0, 1, 2, [](const Eigen::VectorXd& x) { return std::pair(x[0], 3 - x[0] - 0.5 * x[1]); }),
      Eigen::MatrixXd(2, 0));
  EXPECT_DOUBLE_EQ(found.excess, 1.5);
  EXPECT_EQ(found.point, Eigen::Vector2d(1, 1));
}

TEST(Unsurpassed, AreThoseThatNoneIsBetterThanInAll) {
  Eigen::MatrixXd values(2, 6);
  values << 1, 2, 3, 2, 4, 1,  //
      5, 3, 1, 4, 1, 5;
  EXPECT_EQ(unsurpassed(values), (std::vector<int>{0, 1, 2, 5}));
}

}  // namespace cleft
