// A small seeded part of cleft-stress-wound, and cuts that once opened wrongly.
#include "tests/wound/stress/opening_stress.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/incision/meshes.h"
#include "tests/wound/fields.h"

namespace cleft::stress {
namespace {

constexpr double pi = std::numbers::pi;

/// A cut of 30 mm that gapes by 3 mm, in a patch of 60 x 40 mm.
std::shared_ptr<const Field> wide() {
  return std::make_shared<const Field>(testing::opening_field({-15, 30, 3}, 60, 40, 8, 3));
}

Opened opened(const SurfaceMesh& mesh, const ScalpelPath& path) {
  const auto field = wide();
  Incision cut(mesh, path);
  cut.advance_to(path.length());
  return look_at_opened(ReplayedWounds({Wound(cut, *field, 1)}), FieldLimits(*field), 5);
}

/// Of edges' stretch nothing is asked here: the field made up for tests is steeper than its samples tell.
void expect_whole(const Opened& o) {
  EXPECT_EQ(o.turned + o.torn + o.spikes + o.crossed + o.unsteady, 0) << text_of(o);
}

ScalpelPath arc(double radius, double begin, double end) {
  std::vector<Vec3> points;
  for (int i = 0; i <= 72; ++i) {
    const double angle = begin + (end - begin) * i / 72;
    points.push_back({radius * std::cos(angle), radius * std::sin(angle), 0});
  }
  return testing::path_through(points, testing::up, 3);
}

TEST(Opening, ArcsAndLoopsOnARegularPlateTurnNothingOver) {
  const SurfaceMesh plate = testing::grid(100, 100, -60, -60, 1.2);
  for (const auto& [radius, end] : {std::pair{30., pi / 2}, {12., 2 * pi}, {5., 2 * pi}, {12., 1.9 * pi}}) {
    const Opened o = opened(plate, arc(radius, 0, end));
    expect_whole(o);
    EXPECT_GT(o.largest, 0.3) << radius;
  }
}

TEST(Opening, AHookAtThePathsStartCostsItNothingFurtherOn) {
  const SurfaceMesh plate = testing::grid(60, 60, -30, -30, 1);
  std::vector<Vec3> straight, hooked;
  for (int i = 0; i <= 48; ++i) straight.push_back({-12 + 0.5 * i, 0.2, 0});
  hooked = straight;
  hooked.insert(hooked.begin(), {-12.1, 0.5, 0});
  const Opened o = opened(plate, testing::path_through(hooked, testing::up, 3));
  expect_whole(o);
  EXPECT_GT(o.largest, 0.9 * opened(plate, testing::path_through(straight, testing::up, 3)).largest);
}

TEST(Opening, AHandsTremorDoesNotKeepAWoundClosed) {
  const SurfaceMesh plate = testing::grid(120, 120, -30, -30, 0.5);
  std::vector<Vec3> steady, trembling;
  for (int i = 0; i <= 48; ++i) {
    const double x = -15 + 30. * i / 48;
    steady.push_back({x, 0.2, 0});
    trembling.push_back({x, 0.2 + 0.05 * std::sin(9 * x), 0});
  }
  const Opened o = opened(plate, testing::path_through(trembling, testing::up, 3));
  expect_whole(o);
  EXPECT_GT(o.largest, 0.9 * opened(plate, testing::path_through(steady, testing::up, 3)).largest);
}

TEST(Opening, OfRandomCutsOnRegularMeshes) {
  const CutFields fields(wide());
  const FieldLimits limits(fields.shape());
  OpeningPlan plan;
  plan.cuts = 30;
  plan.cuts_at_once = 1;
  plan.positions = 31;
  for (const Subject& subject : generated_subjects(false)) {
    if (subject.name != "plane" && subject.name != "sphere" && subject.name != "torus") continue;
    const OpeningTally tally = open_random_cuts(
        subject, [&] { return CutFields(fields); }, limits, plan);
    // Lines, waves, edges, spirals, eights and zigzags: before displacements fell towards the places where
    // coordinates jump, these turned hundreds of triangles.
    EXPECT_EQ(tally.sum.turned, 0) << subject.name << ": " << text_of(tally.sum);
    EXPECT_EQ(tally.sum.torn + tally.sum.spikes + tally.sum.unsteady, 0) << text_of(tally.sum);
    EXPECT_GT(tally.groups, 20);
  }
}

/// A plate whose triangles are slivers. What the guard makes of some may stretch others: by three times their
/// length at most, and a little more between the positions that it looks at, where the field does not do so.
TEST(Opening, OfRandomCutsThroughSliversStretchesNoEdgeByMuchMoreThanThreeTimes) {
  const CutFields fields(wide());
  FieldLimits limits(fields.shape());
  limits.strain = 3.3 / 3;
  OpeningPlan plan;
  plan.cuts = 300;
  plan.cuts_at_once = 1;
  // The first ones, and two that the guard stretched when it had no limit.
  for (long cut = 0; cut < 30; ++cut) plan.only.push_back(cut);
  plan.only.insert(plan.only.end(), {155, 185});
  for (const Subject& subject : generated_subjects(false)) {
    if (subject.name != "stretched plane") continue;
    const OpeningTally tally = open_random_cuts(
        subject, [&] { return CutFields(fields); }, limits, plan);
    const Opened& o = tally.sum;
    EXPECT_EQ(o.turned + o.torn + o.stretched + o.spikes + o.crossed, 0) << text_of(o);
  }
}

/// A second cut across the first, at many positions of the blade. A triangle of a few hundredths of a
/// millimetre between the lips of a crossing turned over while the blade passed it: nothing had looked there,
/// or the lips would have been held back for good for it.
TEST(Opening, OfPairsThatCrossTurnsNothing) {
  Field pulled = testing::in_tension(
      *wide(), {{"skin.prestress_u", 0.01}, {"skin.prestress_v", 0.03}, {"skin.prestress_uv", 0}});
  const CutFields fields(std::make_shared<const Field>(std::move(pulled)));
  const FieldLimits limits(fields.shape());
  OpeningPlan plan;
  plan.cuts = 16;
  plan.crossing = true;
  plan.positions = 97;
  for (const Subject& subject : generated_subjects(false)) {
    if (subject.name != "plane" && subject.name != "sphere" && subject.name != "torus") continue;
    const OpeningTally tally = open_random_cuts(
        subject, [&] { return CutFields(fields); }, limits, plan);
    const Opened& o = tally.sum;
    EXPECT_EQ(o.turned + o.turned_by_field + o.torn + o.spikes + o.crossed + o.unsteady, 0)
        << subject.name << ": " << text_of(o);
    EXPECT_GT(o.least_determinant, 0.2) << subject.name;
    EXPECT_GT(tally.groups, 4) << subject.name;
  }
}

/// Pairs that turned a triangle where the moments for which its corners are held back begin and end
/// differently.
TEST(Opening, OfPairsInDistortedPlanesTurnsNothingForAMoment) {
  struct Pair {
    std::string mesh;
    std::uint64_t seed;
    long cut;
    double gape, length, width;  // of the field and its patch, mm
  };
  long groups = 0;
  for (const Pair& pair : {Pair{"sheared plane", 1, 18, 4, 90, 60},
                           {"graded plane", 77, 20, 5, 60, 40},
                           {"graded plane", 77, 20, 6, 90, 60}}) {
    const Field field = testing::opening_field({-15, 30, 3}, pair.length, pair.width, 8, pair.gape);
    const CutFields fields(std::make_shared<const Field>(testing::in_tension(
        field, {{"skin.prestress_u", 0.01}, {"skin.prestress_v", 0.03}, {"skin.prestress_uv", 0}})));
    OpeningPlan plan;
    plan.seed = pair.seed, plan.cuts = 24, plan.only = {pair.cut};
    plan.crossing = true;
    plan.positions = 200;
    for (const Subject& subject : generated_subjects(true)) {
      if (subject.name != pair.mesh) continue;
      const OpeningTally tally = open_random_cuts(
          subject, [&] { return CutFields(fields); }, FieldLimits(fields.shape()), plan);
      EXPECT_EQ(tally.sum.turned, 0) << subject.name << ": " << text_of(tally.sum);
      groups += tally.groups;
    }
  }
  EXPECT_EQ(groups, 3);
}

/// What is counted is there: a skin that is pulled through itself.
TEST(Opening, IsCountedAsTurnedWhereItIs) {
  const auto field = std::make_shared<const Field>(testing::opening_field({-15, 30, 3}, 60, 40, 8, 60));
  const SurfaceMesh plate = testing::grid(60, 60, -30, -30, 1);
  const ScalpelPath path = testing::path_through({{-15, 0.2, 0}, {15, 0.2, 0}}, testing::up, 3);
  Incision cut(plate, path);
  cut.advance_to(path.length());
  const ReplayedWounds wounds({Wound(cut, *field, 1)});
  const Opened o = look_at_opened(wounds, FieldLimits(*field), 5);
  EXPECT_GT(o.turned + o.turned_by_field, 10);
  EXPECT_GT(o.turned_by_field, o.turned);
  // And named, also at positions of the blade that the guard does not look at.
  EXPECT_EQ(look_at_opened(wounds, FieldLimits(*field), 29).unnamed, 0);
}

}  // namespace
}  // namespace cleft::stress
