#include "explorer/analysis/posterior.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <random>

#include "base/error.h"

namespace cleft {

namespace {

/// A normal distribution far from the sides of the cube.
struct Normal {
  Eigen::Vector2d mean{0.4, 0.55};
  Eigen::Matrix2d covariance = (Eigen::Matrix2d() << 0.004, 0.0035, 0.0035, 0.004).finished() * 0.5;

  Eigen::VectorXd operator()(const Eigen::MatrixXd& x) const {
    const Eigen::MatrixXd off = x.colwise() - mean;
    return -0.5 * off.cwiseProduct(covariance.ldlt().solve(off)).colwise().sum().transpose();
  }
};

}  // namespace

TEST(Posterior, OfANormalDistributionHasItsMoments) {
  const Normal normal;
  const Posterior found = draw_posterior(2, normal, {.most_steps = 20000, .effective = 8000});
  EXPECT_GT(found.effective, 8000);
  EXPECT_LT((found.points.rowwise().mean() - normal.mean).norm(), 0.002);
  EXPECT_LT((found.covariance() - normal.covariance).norm(), 0.06 * normal.covariance.norm());
  // Of two dimensions: exp(-r^2 / 2) is below 0.1 of the largest with a probability of 0.1.
  EXPECT_NEAR(found.part_below(std::log(0.1)), 0.1, 0.012);
}

TEST(Posterior, OfNothingKnownIsTheWholeCube) {
  const Posterior found = draw_posterior(
      3, [](const Eigen::MatrixXd& x) { return Eigen::VectorXd(Eigen::VectorXd::Zero(x.cols())); });
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(found.points.row(k).mean(), 0.5, 0.04);
    EXPECT_NEAR(found.covariance()(k, k), 1. / 12, 0.008);
  }
}

TEST(Posterior, IsTheSameForTheSameSeed) {
  const Normal normal;
  const PosteriorSettings few{.most_steps = 100};
  EXPECT_EQ(draw_posterior(2, normal, few).points, draw_posterior(2, normal, few).points);
  EXPECT_NE(draw_posterior(2, normal, few).points,
            draw_posterior(2, normal, {.most_steps = 100, .seed = 2}).points);
}

TEST(Posterior, RefusesADensityThatIsZeroEverywhere) {
  EXPECT_THROW(draw_posterior(2,
                              [](const Eigen::MatrixXd& x) {
                                return Eigen::VectorXd(Eigen::VectorXd::Constant(x.cols(), -HUGE_VAL));
                              }),
               InputError);
}

}  // namespace cleft
