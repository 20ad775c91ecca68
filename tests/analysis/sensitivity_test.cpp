#include "explorer/analysis/sensitivity.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/error.h"
#include "tests/support/temporary_folder.h"

namespace cleft {

namespace {

constexpr double pi = std::numbers::pi;

/// Ishigami and Homma's (1990) function, a = 7, b = 0.1.
Eigen::VectorXd ishigami(const Eigen::MatrixXd& x) {
  return x.row(0).array().sin() + 7 * x.row(1).array().sin().square() +
         0.1 * x.row(2).array().pow(4) * x.row(0).array().sin();
}

std::vector<InputDistribution> of_ishigami() {
  std::vector<InputDistribution> list;
  for (const char* name : {"x1", "x2", "x3"}) list.emplace_back(name, -pi, pi);
  return list;
}

}  // namespace

TEST(Sensitivities, OfIshigamisFunctionAreThoseOfItsClosedForm) {
  const Sensitivities found = sensitivities_of(of_ishigami(), ishigami, {}, 8192);
  const double first[] = {0.3139, 0.4424, 0}, total[] = {0.5576, 0.4424, 0.2437};
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(found.parameters[k].first.value, first[k], 0.01) << k;
    EXPECT_NEAR(found.parameters[k].total.value, total[k], 0.01) << k;
    EXPECT_LT(found.parameters[k].total.error, 0.05) << k;
  }
  EXPECT_NEAR(found.mean, 3.5, 0.01);
  EXPECT_NEAR(found.deviation, std::sqrt(13.8446), 0.02);
  // Of x1 alone: 3.5 + (1 + b pi^4 / 5) sin x1.
  const ParameterEffect& effect = found.parameters[0];
  for (std::size_t p = 0; p < effect.at.size(); ++p)
    EXPECT_NEAR(effect.mean[p] - effect.mean[effect.at.size() / 2], 2.948 * std::sin(effect.at[p]), 0.35);
}

TEST(Sensitivities, WhatTheDataLeaveOpenWidensTheIntervals) {
  const auto others = [](const Eigen::MatrixXd& x) {
    const Eigen::RowVectorXd change = x.row(2).array().pow(4) * x.row(0).array().sin(),
                             own = ishigami(x).transpose();
    Eigen::MatrixXd rows(3, x.cols());
    rows << own - 0.02 * change, own, own + 0.02 * change;
    return rows;
  };
  const auto with = sensitivities_of(of_ishigami(), ishigami, others, 1024);
  const auto without = sensitivities_of(of_ishigami(), ishigami, {}, 1024);
  EXPECT_GT(with.parameters[2].total.error, 1.5 * without.parameters[2].total.error);
  EXPECT_EQ(with.parameters[2].total.value, without.parameters[2].total.value);
}

TEST(Sensitivities, AParameterThatDoesNothingHasNoShare) {
  const auto found = sensitivities_of(
      of_ishigami(), [](const Eigen::MatrixXd& x) { return Eigen::VectorXd(x.row(0).transpose()); }, {}, 512);
  EXPECT_NEAR(found.parameters[0].total.value, 1, 0.01);
  EXPECT_NEAR(found.parameters[1].total.value, 0, 1e-12);
  EXPECT_THROW(
      sensitivities_of(
          of_ishigami(),
          [](const Eigen::MatrixXd& x) { return Eigen::VectorXd(Eigen::VectorXd::Constant(x.cols(), 3)); },
          {}, 512),
      InputError);
}

TEST(InputDistribution, IsReadFromItsText) {
  EXPECT_NEAR(InputDistribution("a=uniform(1, 3)").quantile(0.25), 1.5, 1e-12);
  EXPECT_NEAR(InputDistribution("a=loguniform(1, 100)").quantile(0.5), 10, 1e-9);
  EXPECT_NEAR(InputDistribution("a=normal(5,2)").quantile(0.975), 5 + 2 * 1.959964, 1e-5);
  EXPECT_NEAR(InputDistribution("a=triangular(0, 0, 1)").quantile(0.75), 0.5, 1e-9);
  EXPECT_EQ(InputDistribution("a", 0.01, 0.1).text(), "loguniform(0.01, 0.1)");
  EXPECT_EQ(InputDistribution("a", 0.01, 0.09).text(), "uniform(0.01, 0.09)");
  const TemporaryFolder folder;
  const std::string file = folder.write("values.csv", "b,a\n1,4\n2,5\n3,6\n");
  EXPECT_EQ(InputDistribution("a=" + file).quantile(0.5), 5);
  for (const char* text : {"a", "=uniform(0,1)", "a=uniform(1,0)", "a=normal(1,0)", "a=beta(1,2)",
                           "a=uniform(1)", "a=uniform(0,1"})
    EXPECT_ANY_THROW(InputDistribution{text}) << text;
  EXPECT_ANY_THROW(InputDistribution{"c=" + file});
}

TEST(InputDistribution, EachParameterHasOne) {
  const std::vector<RangeOfName> ranges = {{"a", 0, 1}, {"b", 1, 20}};
  const auto all = distributions_of(ranges, {"b=normal(1, 2)"});
  EXPECT_EQ(all[0].text(), "uniform(0, 1)");
  EXPECT_EQ(all[1].text(), "normal(1, 2)");
  EXPECT_THROW(distributions_of(ranges, {"c=normal(1, 2)"}), InputError);
  EXPECT_THROW(distributions_of(ranges, {"b=normal(1, 2)", "b=uniform(0, 1)"}), InputError);
}

}  // namespace cleft
