#include "encoder/interpolate/geometry_model.h"

#include <gtest/gtest.h>

#include "tests/interpolate/made_study.h"

namespace cleft {

namespace {

std::vector<CaseParameters> varied() {
  std::vector<CaseParameters> cases;
  for (const double length : {16., 20., 30.})
    for (const double depth : {2., 5.})
      for (const double v : {0.02, 0.05})
        cases.push_back(
            parameters_with({{"cut.length", length}, {"cut.depth", depth}, {"skin.prestress_v", v}}));
  return cases;
}

std::vector<RecordedParameters> all_recorded(const std::vector<CaseParameters>& cases) {
  std::vector<RecordedParameters> list;
  for (const CaseParameters& one : cases) list.push_back(recorded(one));
  return list;
}

std::vector<FieldGeometry> geometries(const std::vector<CaseParameters>& cases) {
  std::vector<FieldGeometry> list;
  for (const CaseParameters& one : cases) list.push_back(geometry_with(one));
  return list;
}

void expect_alike(const FieldGeometry& a, const FieldGeometry& b) {
  for (int axis = 0; axis < 4; ++axis) {
    EXPECT_NEAR(a.domain[axis].front, b.domain[axis].front, 1e-12);
    EXPECT_NEAR(a.domain[axis].back, b.domain[axis].back, 1e-12);
  }
  EXPECT_NEAR(a.cut.start, b.cut.start, 1e-12);
  EXPECT_NEAR(a.cut.length, b.cut.length, 1e-12);
  EXPECT_NEAR(a.cut.depth, b.cut.depth, 1e-12);
  for (double part = 0; part <= 1; part += 1. / 64)
    EXPECT_NEAR(a.tip.at(part * a.domain[3].back), b.tip.at(part * b.domain[3].back), 1e-11);
}

}  // namespace

TEST(GeometryModel, IsLinearInWhatABodyIsMeasuredBy) {
  const GeometryModel model(all_recorded(varied()), geometries(varied()));
  for (const double length : {16., 17.3, 29., 40.}) {
    const auto p = parameters_with({{"cut.length", length}, {"cut.depth", 3.3}, {"skin.prestress_v", 0.03}});
    expect_alike(model.at(recorded(p)), geometry_with(p));
  }
}

TEST(GeometryModel, GivesEachCaseItsOwnHoweverItsMeshRounds) {
  auto list = geometries(varied());
  for (std::size_t i = 0; i < list.size(); ++i) {
    list[i].cut.depth = std::round(2 * list[i].cut.depth + 0.3 * static_cast<double>(i % 2)) / 2;
    list[i].cut.start += 0.01 * static_cast<double>(i % 3);
    // Tips that do not advance evenly, seen at other times.
    const double l = list[i].cut.length, bend = 0.3 + 0.02 * static_cast<double>(i);
    list[i].tip = {{0, bend * l, l}, {list[i].cut.start, list[i].cut.start + 0.5 * l, list[i].cut.start + l}};
  }
  const GeometryModel model(all_recorded(varied()), list);
  for (std::size_t i = 0; i < list.size(); ++i) expect_alike(model.at(recorded(varied()[i])), list[i]);
  // In between, tips still only advance.
  const auto g = model.at(
      recorded(parameters_with({{"cut.length", 18}, {"cut.depth", 3.3}, {"skin.prestress_v", 0.03}})));
  EXPECT_TRUE(std::is_sorted(g.tip.positions.begin(), g.tip.positions.end()));
  EXPECT_TRUE(std::is_sorted(g.tip.times.begin(), g.tip.times.end()));
  EXPECT_EQ(g.tip.times.back(), g.domain[3].back);
}

}  // namespace cleft
