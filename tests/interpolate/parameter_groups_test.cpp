// Which parameters are varied together, and which alone.
#include "encoder/interpolate/parameter_groups.h"

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

namespace cleft {
namespace {

using Names = std::vector<std::string>;

/// Of cases that differ from the default one in these numbers, each in two tensions.
std::vector<RecordedParameters> cases_of(const std::vector<std::map<std::string, double>>& changes) {
  std::vector<RecordedParameters> cases;
  for (const auto& change : changes)
    for (const double tension : {0.01, 0.02}) {
      RecordedParameters one{Parameters()};
      one.set("skin.prestress_v", tension);
      for (const auto& [name, value] : change) one.set(name, value);
      cases.push_back(one);
    }
  return cases;
}

TEST(ParameterGroups, WhatVariesAloneIsFound) {
  const auto cases = cases_of({{},
                               {{"cut.depth", 2}},
                               {{"cut.depth", 4}},
                               {{"cut.tilt", 30}},
                               {{"cut.tilt", 30}, {"cut.depth", 2}},
                               {{"cut.tilt", 30}, {"cut.depth", 4}},
                               {{"skin.curvature_uv", 0.01}},
                               {{"patch.height", 6}, {"patch.on_bone", 1}}});
  auto numbered = cases;
  for (RecordedParameters& one : numbered)
    if (!one.number("patch.on_bone")) one.set("patch.on_bone", 0.);
  const ParameterGroups groups = parameter_groups(numbered);
  EXPECT_EQ(groups.base.at("cut.depth"), 3);
  EXPECT_EQ(groups.base.at("patch.on_bone"), 0);
  EXPECT_FALSE(groups.base.contains("skin.prestress_v"));
  EXPECT_EQ(groups.together.names, (Names{"cut.depth", "cut.tilt"}));
  EXPECT_EQ(groups.together.cases, (std::vector<int>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11}));
  ASSERT_EQ(groups.alone.size(), 2u);
  for (const ParameterGroup& one : groups.alone)
    if (one.names == Names{"skin.curvature_uv"})
      EXPECT_EQ(one.cases, (std::vector<int>{0, 1, 12, 13}));
    else
      EXPECT_EQ(one.names, (Names{"patch.height", "patch.on_bone"}));
}

TEST(ParameterGroups, AGridAndAStarAreTogether) {
  const auto grid = parameter_groups(
      cases_of({{}, {{"cut.depth", 2}}, {{"cut.tilt", 30}}, {{"cut.tilt", 30}, {"cut.depth", 2}}}));
  EXPECT_TRUE(grid.alone.empty());
  EXPECT_EQ(grid.together.cases.size(), 8u);
  const auto star =
      parameter_groups(cases_of({{}, {{"cut.depth", 2}}, {{"cut.tilt", 30}}, {{"skin.thickness", 1}}}));
  EXPECT_TRUE(star.alone.empty());
  EXPECT_EQ(star.together.names.size(), 3u);
}

}  // namespace
}  // namespace cleft
