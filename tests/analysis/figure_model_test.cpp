#include "explorer/analysis/figure_model.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "tests/analysis/made_cases.h"

namespace cleft {

namespace {

const std::vector<Figure> figures = {Figure("gape"), Figure("gape(3, 18)"), Figure("v(2, -5, 0)")};

}  // namespace

TEST(FigureModel, PredictsCasesThatItDoesNotHoldWithinItsErrors) {
  const FigureModel model(cases_with(drawn(24, 1), figures), figures);
  ASSERT_EQ(model.varying().size(), 3u);
  const auto others = drawn(60, 2);
  Eigen::MatrixXd points(3, std::ssize(others));
  for (std::size_t j = 0; j < others.size(); ++j)
    for (Eigen::Index k = 0; k < 3; ++k)
      points(k, static_cast<Eigen::Index>(j)) =
          others[j].at(model.varying()[static_cast<std::size_t>(k)].name);
  const FigureModel::Answers answers = model.at(points);
  int within = 0, between = 0;
  for (std::size_t j = 0; j < others.size(); ++j)
    for (std::size_t f = 0; f < figures.size(); ++f) {
      const auto row = static_cast<Eigen::Index>(f), column = static_cast<Eigen::Index>(j);
      const double truth = figures[f].of(made_field(others[j]));
      EXPECT_NEAR(answers.values(row, column), truth, 0.002 * std::abs(truth)) << j;
      if (model.outside(points.col(column)) > 0) continue;
      ++between;
      within += std::abs(answers.values(row, column) - truth) <= answers.errors(row, column);
    }
  EXPECT_GT(between, 90);
  EXPECT_GT(within, 0.88 * between);  // 95 % are expected
  for (Eigen::Index f = 0; f < 3; ++f)
    EXPECT_LT(answers.errors.row(f).maxCoeff(), 0.003 * answers.values.row(f).cwiseAbs().maxCoeff());
}

TEST(FigureModel, LeavesOutCasesAsIfTheyHadNotBeenThere) {
  // One at a time by the closed form, and a third of them, against what the others' weights must keep: a case
  // left out has none, and what is predicted of it is what is predicted without it.
  const FigureModel model(cases_with(drawn(24, 3), figures), figures);
  Eigen::MatrixXd places(3, 24);
  for (int i = 0; i < 24; ++i) places.col(i) = model.place_of(i);
  for (int f = 0; f < 3; ++f) {
    const Eigen::MatrixXd without = model.without_parts(24, f)(places);
    for (int i = 0; i < 24; ++i)
      EXPECT_NEAR(without(i, i), model.left_out()(f, i), 1e-6 * model.figures_of(i).norm()) << i;
  }
  const Eigen::MatrixXd thirds = model.without_parts(3, 0)(places);
  double of_left_out = 0, of_others = 0;
  for (int i = 0; i < 24; ++i)
    (i % 3 == 0 ? of_left_out : of_others) += std::abs(thirds(0, i) - model.figures_of(i)[0]);
  EXPECT_GT(of_left_out, 10 * of_others);
}

TEST(FigureModel, ValuesAloneAreThoseWithErrors) {
  const FigureModel model(cases_with(drawn(24, 3), figures), figures);
  Eigen::MatrixXd places(3, 24);
  for (int i = 0; i < 24; ++i) places.col(i) = 0.7 * model.place_of(i) + 0.3 * model.place_of((i + 1) % 24);
  const Eigen::MatrixXd values = model.values()(places), with_errors = model.at(places).values;
  for (int f = 0; f < 3; ++f)  // the same sums, of coefficients that the nearly singular covariance magnifies
    EXPECT_LT((values - with_errors).row(f).norm(), 1e-7 * with_errors.row(f).norm());
}

TEST(FigureModel, TellsHowFarOutsideAPointIs) {
  const FigureModel model(cases_with(drawn(24, 1), figures), figures);
  EXPECT_EQ(model.outside(model.place_of(3)), 0);
  Eigen::VectorXd far = model.place_of(3);
  far[0] *= 5;
  EXPECT_GT(model.outside(far), 0.5);
}

TEST(FigureModel, RefusesAStudyInWhichNothingVaries) {
  EXPECT_THROW(FigureModel(cases_with({{}, {}, {}}, figures), figures), InputError);
}

}  // namespace cleft
