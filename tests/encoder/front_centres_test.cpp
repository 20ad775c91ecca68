// Centroids of cells in which a front ends, against a displacement that is known.
#include "encoder/front_centres.h"

#include <gtest/gtest.h>

#include <cmath>

namespace cleft {

namespace {

/// Two tetrahedra beside v = 0, one on each side, between u = 0, where the cut is closed, and u = 1. The
/// front is at u = 0.2, and the lips at u = 1 are apart by 2 sqrt(0.8).
struct TwoCells {
  std::vector<Sample> samples{{{0, 0, 0}, Side::both},  {{1, 0, 0}, Side::left},   {{1, 0, 0}, Side::right},
                              {{1, 0, -1}, Side::left}, {{1, 0, -1}, Side::right}, {{1, -1, 0}, Side::both},
                              {{1, 1, 0}, Side::both}};
  std::vector<std::array<std::int32_t, 2>> pairs{{1, 2}, {3, 4}};
  CellCentres centres{{{{0.75, -0.25, -0.25}, Side::left}, {{0.75, 0.25, -0.25}, Side::right}},
                      {true, true},
                      {0, 1, 3, 5, 0, 2, 4, 6},
                      {0, 4, 8}};
  Eigen::MatrixX3d d = Eigen::MatrixX3d::Zero(7, 3);

  TwoCells() {
    const double half = std::sqrt(0.8);
    d.col(1) << 0, -half, half, -half, half, 0, 0;
    d.col(0).setConstant(0.5);  // both sides move
  }
  Eigen::MatrixX3d corrected(const std::array<double, 2>& fronts) const {
    Eigen::MatrixX3d means = centres.mean(d);
    FrontCentres(centres, samples, pairs).correct(means, d, fronts);
    return means;
  }
};

}  // namespace

TEST(FrontCentres, LipsAreApartByTheRootOfTheDistanceFromTheFront) {
  const TwoCells cells;
  // In the plane, where the cell's mean takes 3/4 of the opening at u = 1, it is sqrt(0.55 / 0.8) of it; two
  // of the four nodes are lips.
  const double expected = 0.5 * std::sqrt(0.8) * std::sqrt(0.55 / 0.8) / 0.75;
  for (const std::array<double, 2>& fronts : {std::array{0.2, 5.}, {0.2, 1.}}) {
    const Eigen::MatrixX3d means = cells.corrected(fronts);
    EXPECT_NEAR(means(0, 1), -expected, 1e-15);
    EXPECT_NEAR(means(1, 1), expected, 1e-15);
    EXPECT_DOUBLE_EQ(means(0, 0), 0.5);
  }
}

TEST(FrontCentres, CellsWithoutAFrontOrWithBothKeepTheirMean) {
  const TwoCells cells;
  for (const std::array<double, 2>& fronts : {std::array{-1., 5.}, {-1., 0.}, {0.2, 0.6}})
    EXPECT_EQ(cells.corrected(fronts), cells.centres.mean(cells.d));
}

/// The lips' cell ends at its tip, u = 0.8 of cells whose closed node is at u = 1.
TEST(FrontCentres, ATipIsAsAStartFromTheOtherSide) {
  TwoCells cells;
  for (Sample& sample : cells.samples) sample.uvw.x = 1 - sample.uvw.x;
  for (Sample& sample : cells.centres.samples) sample.uvw.x = 1 - sample.uvw.x;
  const Eigen::MatrixX3d at_tip = cells.corrected({-5, 0.8});
  EXPECT_LT((at_tip - TwoCells().corrected({0.2, 5})).norm(), 1e-15);
}

}  // namespace cleft
