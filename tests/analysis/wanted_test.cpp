#include "explorer/analysis/wanted.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/quantiles.h"
#include "base/text.h"
#include "tests/analysis/made_cases.h"

namespace cleft {

namespace {

FigureModel model_of(const Wanted& wanted, int cases = 24) {
  return {cases_with(drawn(cases, 1), wanted.figures()), wanted.figures()};
}

/// All points of a grid in the ranges of the model.
Eigen::MatrixXd grid_of(const FigureModel& model, int steps) {
  Eigen::MatrixXd points(3, steps * steps * steps);
  for (int j = 0; j < points.cols(); ++j) {
    const int numbers[] = {j % steps, j / steps % steps, j / steps / steps};
    for (Eigen::Index k = 0; k < 3; ++k) {
      const FigureModel::Varied& one = model.varying()[static_cast<std::size_t>(k)];
      points(k, j) = one.least + (one.greatest - one.least) * numbers[k] / (steps - 1);
    }
  }
  return points;
}

constexpr int steps = 41;

}  // namespace

TEST(Wanted, ParametersAreThoseOfTheBestPointOfAGrid) {
  // The largest motion beside the cut, where the condition, written out below, is no box.
  const std::string away = "v(2,-5,0)", other = "displacement(0,5,0)";
  const Figure gape("gape"), beside(other);
  std::vector<double> gapes, parts;
  for (const CaseParameters& one : drawn(24, 1)) {
    const Field field = made_field(one);
    gapes.push_back(gape.of(field)), parts.push_back(beside.of(field) / one.at("cut.depth"));
  }
  const double most_gape = median(gapes), most_part = quantile(parts, 0.4);
  const Wanted wanted(
      {{away, false}},
      "gape < " + shortest(most_gape) + " and displacement(0, 5, 0) / cut.depth < " + shortest(most_part),
      false);
  const FigureModel model = model_of(wanted);
  const Eigen::MatrixXd points = grid_of(model, steps), figures = model.values()(points);
  const auto row = [&](const std::string& text) {
    for (std::size_t f = 0; f < wanted.figures().size(); ++f)
      if (wanted.figures()[f].text() == text) return static_cast<Eigen::Index>(f);
    throw std::runtime_error(text);
  };
  ASSERT_EQ(model.varying()[0].name, "cut.depth");
  double best = HUGE_VAL;
  int possible = 0;
  for (Eigen::Index j = 0; j < points.cols(); ++j)
    if (figures(row("gape"), j) < most_gape && figures(row(other), j) / points(0, j) < most_part)
      ++possible, best = std::min(best, figures(row(away), j));
  EXPECT_GT(possible, 1000);
  EXPECT_LT(possible, points.cols() / 2);

  const BestParameters found = best_parameters(model, wanted);
  EXPECT_TRUE(found.holds);
  EXPECT_FALSE(found.certain);  // it is on the limit of the condition
  const double value = found.figures[row(away)];
  EXPECT_LE(value, best);
  // No farther from it than the figure changes over a step of the grid along each axis.
  const Eigen::RowVectorXd all = figures.row(row(away));
  EXPECT_LT(best - value, 3 * (all.maxCoeff() - all.minCoeff()) / steps);
  EXPECT_LT(found.figures[row("gape")], most_gape);
  EXPECT_LT(found.figures[row(other)] / found.point[0], most_part);
}

TEST(Wanted, ConditionsThatAreCertainKeepTheDistanceOfTheErrors) {
  const std::string condition = "gape > 5";
  const Wanted wanted({{"skin.prestress_v", false}}, condition, false),
      certain({{"skin.prestress_v", false}}, condition, true);
  const FigureModel model = model_of(wanted, 8);  // few cases, large errors
  const BestParameters one = best_parameters(model, wanted), other = best_parameters(model, certain);
  ASSERT_TRUE(one.holds && other.holds);
  EXPECT_NEAR(one.figures[0], 5, 1e-3);
  EXPECT_FALSE(one.certain);
  EXPECT_TRUE(other.certain);
  EXPECT_GT(other.errors[0], 1e-3);
  EXPECT_NEAR(other.figures[0] - other.errors[0], 5, 1e-3);
  EXPECT_EQ(model.varying()[1].name, "skin.prestress_v");
  EXPECT_GT(other.point[1], one.point[1]);
}

TEST(Wanted, ConditionsThatNothingFulfilsAreToldSo) {
  const Wanted wanted({{"gape", false}}, "gape > 500", false);
  const FigureModel model = model_of(wanted);
  const BestParameters found = best_parameters(model, wanted);
  EXPECT_FALSE(found.holds);
  EXPECT_GE(found.figures[0] * (1 + 1e-9), model.values()(grid_of(model, 9)).maxCoeff());
  EXPECT_TRUE(best_cases(model, wanted).empty());
}

TEST(Wanted, CasesOfTwoAimsAreThoseThatNoneSurpasses) {
  const Wanted wanted({{"gape", true}, {"tissue.young_modulus", true}}, "cut.depth > 3", false);
  const FigureModel model = model_of(wanted);
  const auto modulus = [&](int i) { return model.parameters_of(i).number("tissue.young_modulus").value(); };
  const auto deep = [&](int i) { return model.parameters_of(i).number("cut.depth").value() > 3; };
  std::vector<int> expected;
  for (int i = 0; i < model.cases(); ++i) {
    bool best = deep(i);
    for (int j = 0; j < model.cases(); ++j)
      best = best && !(j != i && deep(j) && model.figures_of(j)[0] > model.figures_of(i)[0] &&
                       modulus(j) > modulus(i));
    if (best) expected.push_back(i);
  }
  std::sort(expected.begin(), expected.end(),
            [&](int a, int b) { return model.figures_of(a)[0] > model.figures_of(b)[0]; });
  EXPECT_GT(expected.size(), 2u);
  EXPECT_LT(expected.size(), 12u);
  EXPECT_EQ(best_cases(model, wanted), expected);
}

TEST(Wanted, WithoutSenseAreRefused) {
  EXPECT_THROW(Wanted({{"gap", false}}, "", false), InputError);
  EXPECT_THROW(Wanted({{"field", false}}, "", false), InputError);
  EXPECT_THROW(Wanted({{"gape", false}}, "t > 3", false), InputError);
  EXPECT_THROW(Wanted({{"gape", false}}, "gape(1, 2, 3) > 3", false), InputError);
  EXPECT_THROW(Wanted({{"gape", false}}, "gape(1 > 3", false), InputError);
}

}  // namespace cleft
