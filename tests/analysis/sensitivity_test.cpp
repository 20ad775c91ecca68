#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/error.h"
#include "explorer/analysis/interactions.h"
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

TEST(Sensitivities, SmallFirstIndicesAreAsSureAsLargeOnes) {
  // x1 + c x2: shares of 1 / (1 + c^2) and c^2 / (1 + c^2).
  const auto figure = [](const Eigen::MatrixXd& x) {
    return Eigen::VectorXd((x.row(0) + 0.1 * x.row(1)).transpose());
  };
  const Sensitivities found = sensitivities_of(of_ishigami(), figure, {}, 2048);
  const double first[] = {1 / 1.01, 0.01 / 1.01, 0};
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(found.parameters[k].first.value, first[k], found.parameters[k].first.error + 1e-9) << k;
    EXPECT_LT(found.parameters[k].first.error, 0.01) << k;
  }
}

TEST(Interactions, OfIshigamisFunctionAreThoseOfItsClosedForm) {
  const auto distributions = of_ishigami();
  const Sensitivities found = sensitivities_of(distributions, ishigami, {}, 1024);
  const std::vector<Interaction> pairs = interactions_of(distributions, ishigami, {}, found);
  ASSERT_EQ(pairs.size(), 3u);
  EXPECT_EQ(pairs[0].one, 0u);
  EXPECT_EQ(pairs[0].other, 2u);
  EXPECT_NEAR(pairs[0].share.value, 0.2437, 0.01);  // the whole of what x3 does
  for (const std::size_t other : {1u, 2u}) EXPECT_NEAR(pairs[other].share.value, 0, 1e-6) << other;
  // Of x1 and x3, over x2: 3.5 + sin x1 + b x3^4 sin x1.
  const Interaction& pair = pairs[0];
  for (Eigen::Index p = 0; p < pair.mean.rows(); ++p)
    for (Eigen::Index q = 0; q < pair.mean.cols(); ++q) {
      const double x1 = pair.at[static_cast<std::size_t>(p)], x3 = pair.other_at[static_cast<std::size_t>(q)];
      EXPECT_NEAR(pair.mean(p, q), 3.5 + (1 + 0.1 * std::pow(x3, 4)) * std::sin(x1), 0.02) << x1 << " " << x3;
    }
}

TEST(Interactions, IntervalsHoldWhatDrawsAndDataLeaveOpen) {
  // x1 x2 (1 + c x3): of every value of x3, x1 and x2 make something else together.
  const auto distributions = of_ishigami();
  const auto figure = [](double c) {
    return [c](const Eigen::MatrixXd& x) {
      return Eigen::VectorXd((x.row(0).array() * x.row(1).array() * (1 + c * x.row(2).array())).transpose());
    };
  };
  const auto share = [&](double c, const AlternativeFigures& alternatives) {
    const Sensitivities found = sensitivities_of(distributions, figure(c), {}, 1024);
    return interactions_of(distributions, figure(c), alternatives, found)[0].share;
  };
  // Variances: of x1 x2 s^4, of x1 x2 x3 c^2 s^6, with s^2 = pi^2 / 3.
  const double s2 = pi * pi / 3, exact = 1 / (1 + 0.04 * s2);
  const Estimate of_draws = share(0.2, {});
  EXPECT_NEAR(of_draws.value, exact, of_draws.error);
  EXPECT_LT(of_draws.error, 0.1);
  EXPECT_NEAR(share(0, {}).value, 1, 0.01);
  EXPECT_LT(share(0, {}).error, 1e-6);
  const auto others = [&](const Eigen::MatrixXd& x) {
    const Eigen::RowVectorXd own = figure(0)(x).transpose();
    Eigen::MatrixXd rows(3, x.cols());
    rows << 0.98 * own, own, 1.02 * own;
    return rows;
  };
  // Shares of .9604, 1 and 1.0404: 1.96 times the jackknife's deviation of three.
  EXPECT_NEAR(share(0, others).error, 1.96 * std::sqrt(2. / 3 * 2 * 0.04 * 0.04), 0.002);
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
  EXPECT_NEAR(found.parameters[1].first.value, 0, 1e-12);
  for (const std::size_t k : {0u, 1u}) EXPECT_LT(found.parameters[k].first.error, 1e-9) << k;
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
