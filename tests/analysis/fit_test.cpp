#include "explorer/analysis/fit.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "tests/analysis/made_cases.h"
#include "tests/support/temporary_folder.h"

namespace cleft {

namespace {

std::vector<InputDistribution> ranges_of(const FigureModel& model) {
  std::vector<InputDistribution> list;
  for (const FigureModel::Varied& one : model.varying()) list.emplace_back(one.name, one.least, one.greatest);
  return list;
}

/// Motions of three points, of cases with the given values, in the order cut.depth, skin.prestress_v,
/// tissue.young_modulus; and a measurement of each with errors of the given deviation.
const std::vector<Figure> motions = {Figure("v(2, -5, 0)"), Figure("u(6, 4, 0)"), Figure("v(-4, 3, -2)"),
                                     Figure("gape(3)"),     Figure("gape(-4)"),   Figure("w(1, -6, 0)")};

Measurements measured(const CaseParameters& truth, double deviation, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> error(0, deviation);
  Measurements all{motions, Eigen::VectorXd(std::ssize(motions)),
                   Eigen::VectorXd::Constant(std::ssize(motions), deviation)};
  for (Eigen::Index i = 0; i < all.values.size(); ++i)
    all.values[i] = motions[static_cast<std::size_t>(i)].of(made_field(truth)) + error(random);
  return all;
}

}  // namespace

TEST(Fit, FindsTheParametersOfATwin) {
  const FigureModel model(cases_with(drawn(40, 1), motions), motions);
  const CaseParameters truth = {
      {"cut.depth", 3.2}, {"skin.prestress_v", 0.03}, {"tissue.young_modulus", 0.02}};
  const double size = std::abs(motions[0].of(made_field(truth)));
  const Measurements data = measured(truth, 0.01 * size, 1);
  const auto distributions = ranges_of(model);
  const ParameterFit fit = MeasurementFit(model, data, distributions).find();
  EXPECT_GT(fit.misfit_probability, 0.01);
  for (const FittedParameter& p : fit.parameters) {
    EXPECT_LT(p.low, truth.at(p.name)) << p.name;
    EXPECT_GT(p.high, truth.at(p.name)) << p.name;
  }
  // Ten times the noise: as much less is known.
  const Measurements vague = measured(truth, 0.1 * size, 1);
  const ParameterFit less = MeasurementFit(model, vague, distributions).find();
  EXPECT_GT(less.parameters[1].deviation, 3 * fit.parameters[1].deviation);
}

TEST(Fit, TheTruthIsInThe90PercentRegionOf90PercentOfTwins) {
  const FigureModel model(cases_with(drawn(40, 1), motions), motions);
  const auto distributions = ranges_of(model);
  const auto truths = drawn(40, 7);
  int inside = 0;
  for (std::size_t i = 0; i < truths.size(); ++i) {
    const Measurements data = measured(truths[i], 0.02, static_cast<unsigned>(i));
    const MeasurementFit fit(model, data, distributions);
    const Posterior posterior =
        draw_posterior(3, [&](const Eigen::MatrixXd& x) { return fit.log_density(x); },
                       {.most_steps = 250, .effective = 300});
    Eigen::VectorXd place(3);
    for (Eigen::Index k = 0; k < 3; ++k) {
      const FigureModel::Varied& range = model.varying()[static_cast<std::size_t>(k)];
      place[k] =
          std::clamp((truths[i].at(range.name) - range.least) / (range.greatest - range.least), 0., 1.);
    }
    inside += posterior.part_below(fit.log_density(place)[0]) > 0.1;
  }
  EXPECT_GE(inside, 31);  // 36 are expected; fewer than 31 have a probability of 1 %
  EXPECT_LT(inside, 40);  // nor are regions too large: 40 of 40 has one of 1.5 %
}

TEST(Fit, TellsWhatTheDataLeaveOpen) {
  // One motion across the cut grows with the tension and falls with the modulus.
  const std::vector<Figure> one = {Figure("gape(3)")};
  const FigureModel model(cases_with(drawn(40, 1), one), one);
  Measurements data{
      one,
      Eigen::VectorXd::Constant(
          1, one[0].of(
                 made_field({{"cut.depth", 3}, {"skin.prestress_v", 0.03}, {"tissue.young_modulus", 0.02}}))),
      Eigen::VectorXd::Constant(1, 0.01)};
  const auto distributions = ranges_of(model);
  const ParameterFit fit = MeasurementFit(model, data, distributions).find();
  std::string open;
  for (const std::string& sentence : fit.open) open += sentence + "\n";
  EXPECT_NE(open.find("skin.prestress_v and tissue.young_modulus cannot be told apart by these data"),
            std::string::npos)
      << open;
}

TEST(Fit, DataOfNoCaseAreSaidNotToFit) {
  const FigureModel model(cases_with(drawn(40, 1), motions), motions);
  Measurements data =
      measured({{"cut.depth", 3}, {"skin.prestress_v", 0.03}, {"tissue.young_modulus", 0.02}}, 0.01, 1);
  data.values *= -1;
  const auto distributions = ranges_of(model);
  EXPECT_LT(MeasurementFit(model, data, distributions).find({.most_steps = 100}).misfit_probability, 1e-6);
}

TEST(Measurements, AreReadByTheNamesOfTheirColumns) {
  const TemporaryFolder folder;
  const auto read = [&](const std::string& text) {
    return read_measurements(folder.write("m.csv", text), 0.1);
  };
  const Measurements gapes = read("u,gape,deviation\n-5,3.5,0.2\n0,4,0.3\n");
  ASSERT_EQ(gapes.figures.size(), 2u);
  EXPECT_EQ(gapes.figures[0].text(), "gape(-5)");
  EXPECT_EQ(gapes.values[1], 4);
  EXPECT_EQ(gapes.deviations[1], 0.3);
  const Measurements motion = read("u,v,w,t,du,dv\n1,2,0,12,0.1,-0.2\n");
  ASSERT_EQ(motion.figures.size(), 2u);
  EXPECT_EQ(motion.figures[1].text(), "v(1, 2, 0, 12)");
  EXPECT_EQ(motion.deviations[0], 0.1);
  EXPECT_EQ(read("gape\n4\n").figures[0].text(), "gape");
  for (const char* wrong :
       {"u\n1\n", "u,gap\n1,2\n", "u,du\n1,2\n", "t,gape\n1,2\n", "u,gape,deviation\n1,2,0\n", "u,gape\n"})
    EXPECT_ANY_THROW(read(wrong)) << wrong;
}

}  // namespace cleft
