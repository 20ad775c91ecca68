#include "explorer/wound/validity.h"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/incision/meshes.h"
#include "tests/support/recorded.h"
#include "tests/wound/fields.h"

namespace cleft {
namespace {

using namespace testing;

Field pulled(double along, double across) {
  Field field = opening_field({-15, 30, 3}, 80, 60, 6, 0.5);
  field.parameters = recorded({{"skin.prestress_u", along}, {"skin.prestress_v", across}});
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
  const Wound of_a(a, first, 1), of_b(b, second, 1);
  return validity_of({&of_a, &of_b}, turned);
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
    // In skin that is pulled alike a T is off by 0.27 at its mouth, an X by 0.02 (tests/truth).
    EXPECT_EQ(tells(alike[1], "meets another cut"), to == 0 ? 1 : 0);
    EXPECT_NEAR(alike[1].expected_error.largest, to == 0 ? 0.3 : 0.02, 0.01);
    EXPECT_TRUE(alike[0].warnings.empty());
    EXPECT_EQ(tells(two_cuts(pulled(0.01, 0.03), to, 90, false)[1], "the tension does not turn with it"), 1);
  }
}

TEST(Validity, CutsThatMeetAtASlantOrLieBesideEachOtherAreJudgedByTheirDistance) {
  const auto cause = [](const Validity& v) { return v.expected_error.cause; };
  EXPECT_NE(cause(two_cuts(pulled(0.01, 0.03), 5, 45, true)[1]).find("mm beside it"), std::string::npos);
  EXPECT_EQ(cause(two_cuts(pulled(0.01, 0.03), 5, 70, true)[1]).find("mm beside it"), std::string::npos);
  const auto beside = two_cuts(pulled(0.02, 0.02), -2, 90, true);
  EXPECT_FALSE(beside[1].junction_tension);
  EXPECT_EQ(tells(beside[1], "meets another cut"), 0);
  EXPECT_EQ(cause(beside[1]), "another cut is 2 mm beside it");
  EXPECT_NEAR(beside[1].expected_error.largest, 0.075, 0.005);
  EXPECT_NEAR(beside[1].nearest_cut, 2, 0.2);
}

TEST(Validity, ACrossingAtASlantIsJudgedAlikeInAnyTension) {
  EXPECT_LT(two_cuts(pulled(0.02, 0.02), 5, 45, true)[1].expected_error.largest, 0.1);
  EXPECT_LT(two_cuts(pulled(0.01, 0.03), 5, 45, true)[1].expected_error.largest, 0.1);
}

TEST(Validity, ACutThatLiesOtherwiseThanTheFirstIsJudgedByTheAngleWhereTheTensionDoesNotTurn) {
  const auto fixed = two_cuts(pulled(0.01, 0.03), -4, 30, false);
  EXPECT_EQ(tells(fixed[0], "the direction of the first cut"), 0);
  EXPECT_EQ(tells(fixed[1], "it lies 30 degrees from the direction of the first cut"), 1);
  EXPECT_NEAR(fixed[1].expected_error.largest, 0.48, 0.03);
  EXPECT_EQ(tells(two_cuts(pulled(0.01, 0.03), -4, 30, true)[1], "the direction of the first cut"), 0);
}

/// Two straight ways, 4 mm apart, and a bend between: the lips between them have 2 mm to the middle.
TEST(Validity, TellsByHowMuchAndWhereLipsAreHeldBack) {
  const Field field = opening_field({-15, 30, 3}, 80, 60, 6, 4);
  const SurfaceMesh plate = grid(60, 60, -30, -30, 1);
  const auto of = [&](const std::vector<Vec3>& points) {
    Incision cut(plate, path_through(points, up, 3));
    cut.advance_to(cut.path().length());
    const Wound wound(cut, field, 1);
    return validity_of({&wound}, true).front();
  };
  const Validity straight = of({{-12, 0.2, 0}, {12, 0.2, 0}});
  EXPECT_EQ(straight.held_back, 0);
  EXPECT_EQ(tells(straight, "its opening may be off by"), 0);
  std::vector<Vec3> back;
  for (int i = 0; i <= 12; ++i) back.push_back({-12. + i, -2, 0});
  for (int i = 1; i < 6; ++i)
    back.push_back({2 * std::sin(std::numbers::pi * i / 6), -2 * std::cos(std::numbers::pi * i / 6), 0});
  for (int i = 0; i <= 12; ++i) back.push_back({-1. * i, 2, 0});
  const Validity hairpin = of(back);
  EXPECT_GT(hairpin.held_back, 0.1);
  EXPECT_EQ(tells(hairpin, "its opening may be off by"), 1);
  EXPECT_GT(hairpin.held_back_at, 3);
  EXPECT_LT(hairpin.held_back_at, 27);
}

TEST(Validity, OfAWayThatIsFoundOnTheGoOnlyWhatTheBladeHasCutIsJudged) {
  // Three quarters of a circle of 8 mm about (0, 8); straight ahead it would pass beside its own start.
  CutMesh mesh(grid(60, 60, -30, -30, 1));
  const auto at = [](double a) { return Vec3{8 * std::sin(a), 8 - 8 * std::cos(a), 0}; };
  IncisionOptions options;
  options.max_edge = 0;
  Incision cut(mesh, path_through({{0, 0, 0}, {30, 0, 0}}, up, 3), options);
  for (int k = 1; k <= 160; ++k) cut.extend({at(1.5 * std::numbers::pi * k / 160), {0, 0, 1}, 3}, 15);
  const Field field = pulled(0.01, 0.01);
  const Wound wound(cut, field, 1);
  const Validity v = validity_of({&wound}, true).front();
  // The way's direction lags by a quarter of a piece's turn, e, after the first one. Looked at over a
  // twentieth of its length, d, that is a bend of 1 / (1/8 + 2 e/d).
  const double turn = 1.5 * std::numbers::pi / 160, d = 0.05 * 12 * std::numbers::pi;
  EXPECT_GT(v.smallest_radius, 1 / (1. / 8 + 2 * turn / 4 / d));
  EXPECT_LT(v.smallest_radius, 8.05);
  EXPECT_NEAR(v.expected_error.stations.back(), 37.7, 0.1);
  EXPECT_LT(v.largest_tilt, 1e-6);
}

}  // namespace
}  // namespace cleft
