#include "encoder/interpolate/convex_hull.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace cleft {

TEST(ConvexHull, OfASquare) {
  Eigen::MatrixXd square(5, 2);
  square << -1, -1, 1, -1, 1, 1, -1, 1, 0.2, 0.3;
  const auto distance = [&](double x, double y) { return distance_to_hull(square, Eigen::Vector2d(x, y)); };
  EXPECT_EQ(distance(0, 0), 0);
  EXPECT_EQ(distance(0.99, -0.99), 0);
  EXPECT_EQ(distance(1, 1), 0);
  EXPECT_NEAR(distance(3, 0.5), 2, 1e-12);
  EXPECT_NEAR(distance(-2, -3), std::sqrt(5.), 1e-12);
}

TEST(ConvexHull, OfABallsPointsInFourDimensions) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  Eigen::MatrixXd points(400, 4);
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    for (Eigen::Index k = 0; k < 4; ++k) points(i, k) = normal(random);
    points.row(i).normalize();
  }
  for (int n = 0; n < 50; ++n) {
    Eigen::VectorXd x(4);
    for (Eigen::Index k = 0; k < 4; ++k) x[k] = normal(random);
    // Sums of cases, with shares that sum to 1, lie inside; a distance never exceeds that to the nearest
    // case, nor falls below that from the ball itself.
    Eigen::VectorXd shares = Eigen::VectorXd::Zero(400);
    for (int k = 0; k < 6; ++k) shares[static_cast<Eigen::Index>(random() % 400)] += 1. / 6;
    EXPECT_LT(distance_to_hull(points, points.transpose() * shares), 1e-12);
    x *= 2 / x.norm();
    const double distance = distance_to_hull(points, x);
    EXPECT_GE(distance, 1 - 1e-12);
    EXPECT_LE(distance, (points.rowwise() - x.transpose()).rowwise().norm().minCoeff() + 1e-12);
  }
}

}  // namespace cleft
