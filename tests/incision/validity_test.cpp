#include "explorer/scene/validity.h"

#include <gtest/gtest.h>

#include "tests/incision/fields.h"
#include "tests/incision/meshes.h"

namespace cleft {
namespace {

using namespace testing;

Field pulled(double along, double across) {
  Field field = opening_field({-15, 30, 3}, 80, 60, 6, 0.5);
  field.parameters["skin.prestress_u"] = along;
  field.parameters["skin.prestress_v"] = across;
  return field;
}

/// A cut along x, 24 long, and another one to (0.3, `to`) at an angle to it (degrees).
std::vector<Validity> two_cuts(const Field& first, double to, double angle, bool turned) {
  CutMesh mesh(grid(40, 40, -20, -20, 1));
  IncisionOptions options;
  options.max_edge = 0;
  Incision a(mesh, path_through({{-12, 0, 0}, {12, 0, 0}}, up, 3), options);
  a.advance_to(a.path().length());
  const double back = 8 / std::tan(angle * std::numbers::pi / 180);
  Incision b(mesh, path_through({{0.3 - back * (8 + to) / 8, -8, 0}, {0.3, to, 0}}, up, 3), options);
  b.advance_to(b.path().length());
  const Field second = pulled(0.03, 0.01);
  const IncisionVolume of_a(a, first, 1), of_b(b, second, 1);
  const VaryingField along_a(first), along_b(second);
  return validity_of({{&a, &along_a, &of_a}, {&b, &along_b, &of_b}}, turned);
}

int tells(const Validity& v, const std::string& what) {
  return static_cast<int>(std::count_if(v.warnings.begin(), v.warnings.end(), [&](const std::string& w) {
    return w.find(what) != std::string::npos;
  }));
}

TEST(Validity, BranchesAndCrossingsAreJudgedByTheTensionAlongTheCutTheyMeet) {
  for (const double to : {0., 5.}) {  // a T and an X
    const auto apart = two_cuts(pulled(0.01, 0.03), to, 90, true);
    ASSERT_TRUE(apart[1].junction_tension) << to;
    EXPECT_NEAR(*apart[1].junction_tension, 1. / 3, 1e-12);
    EXPECT_FALSE(apart[0].junction_tension);
    for (const Validity& v : apart) EXPECT_TRUE(v.warnings.empty()) << v.warnings.front();

    const auto alike = two_cuts(pulled(0.02, 0.02), to, 90, true);
    EXPECT_EQ(*alike[1].junction_tension, 1);
    EXPECT_EQ(tells(alike[1], "meets another cut"), 1);
    EXPECT_TRUE(alike[0].warnings.empty());
    EXPECT_EQ(tells(two_cuts(pulled(0.01, 0.03), to, 90, false)[1], "give --tension"), 1);
  }
}

TEST(Validity, CutsThatMeetAtASlantOrLieBesideEachOtherAreJudgedByTheirDistance) {
  EXPECT_EQ(tells(two_cuts(pulled(0.01, 0.03), 5, 45, true)[1], "comes as near as"), 1);
  EXPECT_EQ(tells(two_cuts(pulled(0.01, 0.03), 5, 70, true)[1], "comes as near as"), 0);
  const auto beside = two_cuts(pulled(0.02, 0.02), -2, 90, true);
  EXPECT_FALSE(beside[1].junction_tension);
  EXPECT_EQ(tells(beside[1], "meets another cut"), 0);
  EXPECT_EQ(tells(beside[1], "comes as near as 2 mm"), 1);
  EXPECT_NEAR(beside[1].nearest_cut, 2, 0.2);
}

}  // namespace
}  // namespace cleft
