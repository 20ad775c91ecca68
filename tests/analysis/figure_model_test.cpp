#include "explorer/analysis/figure_model.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "tests/analysis/made_cases.h"

namespace cleft {

namespace {

const std::vector<Figure> figures = {Figure("gape"), Figure("gape(3, 18)"), Figure("v(2, -5, 0)")};

/// The values of what varies in the model, a column for each.
Eigen::MatrixXd points_of(const FigureModel& model, const std::vector<CaseParameters>& list) {
  Eigen::MatrixXd points(std::ssize(model.varying()), std::ssize(list));
  for (Eigen::Index j = 0; j < points.cols(); ++j)
    for (Eigen::Index k = 0; k < points.rows(); ++k)
      points(k, j) = list[static_cast<std::size_t>(j)].at(model.varying()[static_cast<std::size_t>(k)].name);
  return points;
}

}  // namespace

TEST(FigureModel, PredictsCasesThatItDoesNotHoldWithinItsErrors) {
  const FigureModel model(cases_with(drawn(24, 1), figures), figures);
  ASSERT_EQ(model.varying().size(), 3u);
  const auto others = drawn(60, 2);
  const Eigen::MatrixXd points = points_of(model, others);
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

/// Of a modulus over two decades eight cases know little without.
TEST(FigureModel, DerivativesByAParameterReplaceCases) {
  std::vector<CaseParameters> cases = drawn(8, 1), others = drawn(100, 2);
  for (auto* list : {&cases, &others})
    for (CaseParameters& one : *list)
      one["tissue.young_modulus"] = std::pow(one["tissue.young_modulus"] / 0.01, 3) * 0.005;
  const FigureModel plain(cases_with(cases, figures), figures),
      with(cases_with_slopes(cases, figures), figures);
  const Eigen::MatrixXd points = points_of(with, others);
  const FigureModel::Answers one = plain.at(points), other = with.at(points);
  double off = 0, off_with = 0;
  int within = 0;
  for (std::size_t j = 0; j < others.size(); ++j) {
    const double truth = figures[0].of(made_field(others[j]));
    const auto column = static_cast<Eigen::Index>(j);
    off += std::abs(one.values(0, column) - truth), off_with += std::abs(other.values(0, column) - truth);
    within += std::abs(other.values(0, column) - truth) <= other.errors(0, column);
  }
  EXPECT_LT(off_with, 0.5 * off);
  EXPECT_GE(within, 88);  // 95 are expected
  const Eigen::MatrixXd values = with.values()(points);
  for (int f = 0; f < 3; ++f) EXPECT_LT((values - other.values).row(f).norm(), 1e-7 * values.row(f).norm());
}

/// One at a time by the closed form, against what the others' weights must keep: a case left out has none,
/// and what is predicted of it is what is predicted without it.
TEST(FigureModel, LeavesOutCasesAsIfTheyHadNotBeenThere) {
  const FigureModel model(cases_with(drawn(24, 3), figures), figures);
  Eigen::MatrixXd places(3, 24);
  for (int i = 0; i < 24; ++i) places.col(i) = model.place_of(i);
  for (int f = 0; f < 3; ++f) {
    const Eigen::MatrixXd without = model.without_parts(24, f)(places);
    for (int i = 0; i < 24; ++i)
      EXPECT_NEAR(without(i, i), model.left_out()(f, i), 1e-6 * model.figures_of(i).norm()) << i;
  }
}

/// Against the regression itself, which a test of its own compares with one that never had the case.
TEST(FigureModel, ACaseLeftOutTakesItsDerivativesWithIt) {
  const FigureModel::Cases cases = cases_with_slopes(drawn(24, 3), figures);
  const FigureModel model(cases, figures);
  CaseSamples samples{{}, cases.displacements, cases.derivative_of, cases.by, cases.derivatives};
  for (int i = 0; i < 24; ++i) samples.cases.push_back(i);
  const DisplacementModel same = best_model(cases.parameters, samples, loadings_of(cases.parameters.front()));
  ASSERT_TRUE(same.uses_derivatives());
  const DisplacementModel::Predictions others = same.left_out();
  const Eigen::MatrixXd predicted =
      cases.displacements * others.weights + cases.derivatives * others.derivatives;
  Eigen::MatrixXd places(3, 24);
  for (int i = 0; i < 24; ++i) places.col(i) = model.place_of(i);
  const Eigen::MatrixXd without = model.without_parts(24, 0)(places);
  for (int i = 0; i < 24; ++i) {
    const double truth = figures[0].of(predicted.col(i).head(3 * std::ssize(figures[0].places({}))));
    EXPECT_NEAR(model.left_out()(0, i), truth, 1e-7 * truth) << i;
    EXPECT_NEAR(without(i, i), truth, 1e-7 * truth) << i;
  }
}

TEST(FigureModel, LeavesOutAThirdOfTheCases) {
  const FigureModel model(cases_with(drawn(24, 3), figures), figures);
  Eigen::MatrixXd places(3, 24);
  for (int i = 0; i < 24; ++i) places.col(i) = model.place_of(i);
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
