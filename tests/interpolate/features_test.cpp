#include "encoder/interpolate/features.h"

#include <gtest/gtest.h>

#include "tests/interpolate/made_study.h"

namespace cleft {

namespace {

std::vector<RecordedParameters> varied_records() {
  std::vector<RecordedParameters> cases;
  for (const double E : {0.01, 0.02, 0.04})
    for (const double depth : {2., 3., 5.})
      for (const double v : {0.02, 0.05})
        cases.push_back(recorded(
            parameters_with({{"tissue.young_modulus", E}, {"cut.depth", depth}, {"skin.prestress_v", v}})));
  return cases;
}

}  // namespace

TEST(Features, AreWithoutDimension) {
  // The same body, measured in other units of length and of stress.
  const Features features(varied_records(), Loading::superposed);
  const auto p =
      parameters_with({{"tissue.young_modulus", 0.013}, {"cut.depth", 4}, {"skin.prestress_v", 0.033}});
  for (const auto& [length, stress] : {std::pair{2., 1.}, {1., 3.}, {0.25, 7.}}) {
    auto q = p;
    for (auto& [name, value] : q) {
      const bool modulus =
          name.find("young_modulus") != std::string::npos || name.find("prestress") != std::string::npos;
      const bool spring = name.find("foundation") != std::string::npos;
      const bool ratio = name.find("poisson") != std::string::npos || name == "mesh.grading";
      value *= modulus ? stress : spring ? stress / length : ratio ? 1 : length;
    }
    const RecordedParameters scaled = recorded(q), own = recorded(p);
    EXPECT_LT((features.at(scaled) - features.at(own)).norm(), 1e-12);
    EXPECT_LT((features.load(scaled) - features.load(own)).norm(), 1e-12);
    EXPECT_NEAR(features.scale(scaled), length * features.scale(own), 1e-12);
    EXPECT_EQ(features.off(scaled), 0);
  }
}

TEST(Features, FollowTheParametersThatVary) {
  const Features features(varied_records(), Loading::superposed);
  // Stiffness moves the skin's ratio and both springs', which follow from one another.
  ASSERT_EQ(features.size(), 2);
  EXPECT_NE(features.names()[0].find("skin.young_modulus"), std::string::npos);
  EXPECT_NE(features.names()[1].find("cut.depth"), std::string::npos);
  for (const RecordedParameters& one : varied_records()) {
    EXPECT_LE(features.at(one).cwiseAbs().maxCoeff(), 1 + 1e-12);
    EXPECT_EQ(features.off(one), 0);
  }
  EXPECT_EQ(Features(varied_records(), Loading::general).size(), 3);
}

TEST(Features, OfCurvaturesAreTheirAnglesWithSigns) {
  std::vector<RecordedParameters> cases;
  for (const double curvature : {-0.02, 0., 0.01, 0.02})
    for (const double slope : {-0.1, 0.2})
      for (const double tilt : {0., 30.})
        cases.push_back(recorded(
            parameters_with({{"cut.curvature", curvature}, {"patch.slope", slope}, {"cut.tilt", tilt}})));
  const Features features(cases, Loading::superposed);
  ASSERT_EQ(features.size(), 3);
  EXPECT_EQ(features.names()[0], "cut.curvature cut.length");
  const auto at = [&](double curvature, double slope, double tilt) -> Eigen::VectorXd {
    return features.at(recorded(
        parameters_with({{"cut.curvature", curvature}, {"patch.slope", slope}, {"cut.tilt", tilt}})));
  };
  // From -1 to 1, in proportion.
  EXPECT_NEAR(at(0.02, 0, 0)[0], 1, 1e-12);
  EXPECT_NEAR(at(0.005, 0, 0)[0], 0.25, 1e-12);
  EXPECT_NEAR(at(-0.01, 0, 0)[0], -0.5, 1e-12);
  EXPECT_NEAR((at(0, 0.05, 15) - at(0, -0.1, 0)).cwiseAbs().minCoeff(), 0, 1e-12);
  EXPECT_NEAR((at(0, 0.05, 15) - at(0, -0.1, 0)).sum(), 2, 1e-12);  // half of both ranges
}

TEST(Features, KnowWhatTheStudyNeverVariedAlone) {
  // Springs as stiff as the tissue in all cases: their ratio to it is always the same.
  std::vector<RecordedParameters> cases;
  for (const double E : {0.01, 0.02, 0.04})
    cases.push_back(
        recorded(parameters_with({{"tissue.young_modulus", E}, {"foundation.stiffness", E / 4}})));
  const Features features(cases, Loading::superposed);
  EXPECT_EQ(features.off(recorded(
                parameters_with({{"tissue.young_modulus", 0.03}, {"foundation.stiffness", 0.0075}}))),
            0);
  EXPECT_GT(features.off(
                recorded(parameters_with({{"tissue.young_modulus", 0.03}, {"foundation.stiffness", 0.005}}))),
            0.1);
}

TEST(Features, EveryLengthIsMeasuredInLengthsOfTheCut) {
  for (const Parameter& row : parameter_table()) {
    if (row.unit != "mm" || row.name == "cut.length" || row.name == "skin.thickness") continue;
    SCOPED_TRACE(row.name);
    std::vector<RecordedParameters> cases;
    for (const double value : {2., 4., 8.}) cases.push_back(recorded(parameters_with({{row.name, value}})));
    const Features features(cases, Loading::superposed);
    ASSERT_EQ(features.names(), std::vector<std::string>{row.name + " / cut.length"});
    EXPECT_NEAR(features.at(cases[1])[0], 0, 1e-12) << "the middle of the logarithms";
    const double length = *cases[0].number("cut.length");
    const auto other = recorded(parameters_with({{row.name, 2 * 1.5}, {"cut.length", 1.5 * length}}));
    EXPECT_NEAR(features.at(other)[0], features.at(cases[0])[0], 1e-12);
  }
}

TEST(Features, OfImportedDataAreTheirParameters) {
  std::vector<RecordedParameters> cases;
  for (const double speed : {1., 10., 100.})
    cases.push_back(recorded({{"speed", speed}, {"angle", speed - 10}, {"size", 2}}));
  const Features features(cases, Loading::superposed);
  EXPECT_EQ(features.loading(), Loading::general);
  EXPECT_EQ(features.names(), (std::vector<std::string>{"angle", "speed"}));
  EXPECT_NEAR(features.at(recorded({{"speed", 10}, {"angle", 0}, {"size", 2}}))[1], 0,
              1e-12);  // the middle of decades
  EXPECT_EQ(features.scale(cases[0]), 1);
}

}  // namespace cleft
