#include "explorer/analysis/next_cases.h"

#include <gtest/gtest.h>

#include <boost/random/sobol.hpp>

#include "tests/analysis/made_cases.h"

namespace cleft {

namespace {

const std::vector<Figure> field_alone = {Figure("field")};
const std::vector<std::string> names = {"cut.depth", "skin.prestress_v", "tissue.young_modulus"};
const Eigen::Vector3d least(2, 0.02, 0.01), lengths(3, 0.03, 0.03);

/// The first points of the sequence in the box, from a number on.
Eigen::MatrixXd sequence(int from, int count) {
  boost::random::sobol random(3);
  Eigen::MatrixXd points(3, count);
  for (int j = -from; j < count; ++j)
    for (Eigen::Index k = 0; k < 3; ++k) {
      const double part = static_cast<double>(random() >> 11) * 0x1p-53;
      if (j >= 0) points(k, j) = least[k] + lengths[k] * part;
    }
  return points;
}

std::vector<CaseParameters> values_of(const Eigen::MatrixXd& points) {
  std::vector<CaseParameters> list;
  for (Eigen::Index j = 0; j < points.cols(); ++j) {
    CaseParameters& one = list.emplace_back();
    for (Eigen::Index k = 0; k < 3; ++k) one[names[static_cast<std::size_t>(k)]] = points(k, j);
  }
  return list;
}

FigureModel model_of(const Eigen::MatrixXd& points) {
  return {cases_with(values_of(points), field_alone), field_alone};
}

Eigen::MatrixXd corners() {
  Eigen::MatrixXd points(3, 8);
  for (int j = 0; j < 8; ++j)
    for (int k = 0; k < 3; ++k) points(k, j) = least[k] + (j >> k & 1) * lengths[k];
  return points;
}

/// The largest error of the model at points that it does not hold.
double true_error(const FigureModel& model, const Eigen::MatrixXd& points, const Figure& figure) {
  const FigureModel one(cases_with(values_of(points), {figure}), {figure});  // its cases are the truth
  double worst = 0, largest = 0;
  const Eigen::MatrixXd predicted = model.at(points).values;
  for (int j = 0; j < one.cases(); ++j) {
    worst = std::max(worst, std::abs(predicted(0, j) - one.figures_of(j)[0]));
    largest = std::max(largest, one.figures_of(j)[0]);
  }
  return worst / largest;
}

}  // namespace

TEST(NextCases, TellMoreThanAsManyOfASequence) {
  Eigen::MatrixXd points = sequence(0, 12);
  const Eigen::MatrixXd candidates = sequence(100, 512), held_out = sequence(2000, 150);
  for (int batch = 0; batch < 4; ++batch) {
    const NextCases next = next_cases(model_of(points), candidates, lengths, Eigen::MatrixXd(3, 0), 4);
    points.conservativeResize(Eigen::NoChange, points.cols() + 4);
    points.rightCols(4) = next.points;
  }
  // A sequence leaves the ends of the ranges to extrapolation, where errors are largest.
  const FigureModel chosen = model_of(points), drawn = model_of(sequence(0, 28));
  EXPECT_LT(true_error(chosen, corners(), field_alone[0]),
            0.5 * true_error(drawn, corners(), field_alone[0]));
  EXPECT_LT(true_error(chosen, held_out, field_alone[0]), 1.2 * true_error(drawn, held_out, field_alone[0]));
}

TEST(NextCases, OfABatchAreApart) {
  const NextCases next =
      next_cases(model_of(sequence(0, 12)), sequence(100, 512), lengths, Eigen::MatrixXd(3, 0), 8);
  ASSERT_EQ(next.points.cols(), 8);
  for (Eigen::Index a = 0; a < 8; ++a)
    for (Eigen::Index b = 0; b < a; ++b)
      EXPECT_GT((next.points.col(a) - next.points.col(b)).cwiseQuotient(lengths).norm(), 0.15);
  EXPECT_LE(next.errors.maxCoeff(), next.error);
}

TEST(NextCases, KeepAwayFromCasesThatFailed) {
  const FigureModel model = model_of(sequence(0, 12));
  const Eigen::MatrixXd candidates = sequence(100, 512);
  const Eigen::MatrixXd wanted = next_cases(model, candidates, lengths, Eigen::MatrixXd(3, 0), 1).points;
  const NextCases next = next_cases(model, candidates, lengths, wanted, 8);
  for (const auto& point : next.points.colwise())
    EXPECT_GT((point - wanted.col(0)).cwiseQuotient(lengths).norm(), 0.1);
}

}  // namespace cleft
