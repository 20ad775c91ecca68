// How lips lean at a crossing, against simulations of cuts that cross (cleft-truth-bodies).
#include "explorer/wound/corner_lean.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "tests/incision/meshes.h"
#include "tests/wound/fields.h"

namespace cleft {
namespace {

using namespace testing;

constexpr double half = 15;  // mm, of the cuts

/// Two cuts that cross in their middles: along x, and at an angle to it, in radians.
class Crossed {
 public:
  explicit Crossed(double angle, double depth)
      : field_(in_tension(opening_field({-half, 2 * half, 3}, 50, 50, 6, 4), {{"skin.thickness", 1.5}})),
        mesh_(grid(60, 40, -60.3, -40.1, 2)) {
    const double c = half * std::cos(angle), s = half * std::sin(angle);
    for (const auto& [x, y] : {std::pair(half, 0.), {c, s}}) {
      made_.push_back(std::make_unique<Incision>(mesh_, path_through({{-x, -y, 0}, {x, y, 0}}, up, depth),
                                                 IncisionOptions{}));
      made_.back()->advance_to(made_.back()->path().length());
    }
    for (const auto& cut : made_) wounds_.push_back(std::make_unique<Wound>(*cut, field_, 1));
  }

  struct Opening {
    double along, across;  // mm
  };
  /// Of the first cut, where the cuts open so, with the blade at so many mm of the second one.
  CornerLean corners(const Opening& first, const Opening& second, double blade) const {
    const auto amplitude = [&](const Opening& opening) {
      return Amplitude{{0}, {opening.across / alone()}, {0}, {opening.along / alone()}};
    };
    const std::vector<const Wound*> cuts = {wounds_[0].get(), wounds_[1].get()};
    const std::vector<Crossing> crossings = crossings_of(cuts);
    EXPECT_EQ(crossings.size(), 2u);
    return lean_at(crossings.front(), cuts, blade, {amplitude(first), amplitude(second)});
  }
  /// mm: how much higher the lip at v > 0 is than the other one, behind the crossing (1) or before it (-1),
  /// of complete cuts.
  double lean(const Opening& first, const Opening& second, double behind = 1) const {
    const CornerLean found = corners(first, second, 2 * half);
    return (behind > 0 ? found.after : found.before) * alone();
  }

 private:
  double alone() const {
    return field_.displacement({0, 0, 0}, Side::right, 2 * half).y -
           field_.displacement({0, 0, 0}, Side::left, 2 * half).y;
  }

  Field field_;
  CutMesh mesh_;
  std::vector<std::unique_ptr<Incision>> made_;
  std::vector<std::unique_ptr<Wound>> wounds_;
};

constexpr double degrees = std::numbers::pi / 180;

/// Pulled alike in all directions the acute corners rise above the others, pulled 1 : 3 the obtuse ones.
TEST(CornerLean, IsThatOfSimulatedCrossings) {
  struct Simulated {
    double angle, depth;
    Crossed::Opening first, second;
    double lean;
  };
  for (const Simulated& one : {Simulated{30, 3, {0.92, 2.31}, {-0.93, 2.31}, 0.23},
                               {30, 3, {0.18, 3.89}, {0.87, 1.72}, -0.73},
                               {45, 3, {0.75, 2.50}, {-0.75, 2.50}, 0.18},
                               {45, 3, {0.25, 4.58}, {0.91, 0.99}, -0.62},
                               {60, 3, {0.52, 2.64}, {-0.53, 2.64}, 0.14},
                               {60, 3, {0.23, 5.14}, {0.74, 0.38}, -0.46},
                               {75, 3, {0.15, 5.49}, {0.43, 0.02}, -0.24},
                               {45, 5, {0.15, 5.29}, {0.83, 0.82}, -0.84},
                               {45, 2, {0.30, 4.02}, {0.96, 1.09}, -0.50}}) {
    const Crossed cuts(one.angle * degrees, one.depth);
    for (const double behind : {-1., 1.})
      EXPECT_NEAR(behind * cuts.lean(one.first, one.second, behind), one.lean,
                  0.12 * std::abs(one.lean) + 0.02)
          << one.angle << " degrees, " << one.depth << " mm deep";
  }
}

/// Beside a cut that leaves another one a corner stands against a lip that stays straight.
TEST(CornerLean, WhereACutLeavesAnotherIsThatOfSimulatedBranches) {
  CutMesh mesh(grid(60, 40, -60.3, -40.1, 2));
  const Field field =
      in_tension(opening_field({-half, 2 * half, 3}, 50, 50, 6, 4), {{"skin.thickness", 1.5}});
  for (const double angle : {90., 60.}) {
    CutMesh skin = mesh;
    const Vec3 along{std::cos(angle * degrees), std::sin(angle * degrees), 0};
    Incision main(skin, path_through({{-half, 0, 0}, {half, 0, 0}}, up, 3), IncisionOptions{});
    main.advance_to(2 * half);
    Incision branch(skin, path_through({-0.1 * along, half * along}, up, 3), IncisionOptions{});
    branch.advance_to(branch.path().length());
    Wound of_main(main, field, 1), of_branch(branch, field, 1);
    ASSERT_TRUE(of_branch.opens_into(of_main, false));
    of_branch.volume.opens_into(main, false);
    const std::vector<const Wound*> cuts = {&of_main, &of_branch};
    const auto alone = [&](const Wound& cut, double s) {
      const auto [u, time] = cut.volume.canonical(s, cut.complete());
      const double t = std::clamp(cut.complete() + time, 0., 2 * half);
      return field.displacement({u, 0, 0}, Side::right, t).y - field.displacement({u, 0, 0}, Side::left, t).y;
    };
    const double across = alone(of_main, half);
    // Pulled alike, of cuts of 30 and 15 mm, in elements of 0.5 mm.
    const double branch_alone = alone(of_branch, of_branch.volume.opens_on(false));
    const std::vector<Amplitude> in_membrane = {
        {{0}, {(angle == 90 ? 3.25 : 3.2) / across}},
        {{0}, {(angle == 90 ? 2.5 : 2.41) / branch_alone}, {0}, {(angle == 90 ? 0 : -0.46) / branch_alone}}};
    const std::vector<Crossing> mouths = crossings_of(cuts);
    ASSERT_EQ(mouths.size(), 1u);
    EXPECT_NEAR(mouths[0].s, half, 0.1);
    const CornerLean found = lean_at(mouths[0], cuts, branch.path().length(), in_membrane);
    EXPECT_NEAR(found.before * across, angle == 90 ? 0.45 : 0.37, 0.1) << angle;
    EXPECT_NEAR(found.after * across, angle == 90 ? 0.43 : 0.5, 0.1) << angle;
  }
}

TEST(CornerLean, IsNoneAtARightAngleAndNoneBeforeTheCornersAreFree) {
  EXPECT_NEAR(Crossed(90 * degrees, 3).lean({0, 5}, {0, 0.2}), 0, 1e-9);
  const Crossed slant(45 * degrees, 3);
  EXPECT_LT(slant.lean({0.3, 4.6}, {0.9, 1}), -0.2);
  const auto share = [&](double blade) { return slant.corners({0.3, 4.6}, {0.9, 1}, blade).share; };
  EXPECT_EQ(share(half - 1), 0);  // the blade is before the crossing
  EXPECT_NEAR(share(half + 1.5), 0.5, 1e-4);
  EXPECT_EQ(share(half + 3), 1);  // it is a depth behind
}

TEST(CornerLean, FallsByEOverItsReachToEitherSide) {
  const CornerLean one{0.1, -0.1, 1, 1, 2};
  EXPECT_EQ(one.at(0), 1);
  EXPECT_NEAR(one.at(2), std::exp(-1.), 1e-12);
  EXPECT_NEAR(one.at(-1), std::exp(-1.), 1e-12);
}

}  // namespace
}  // namespace cleft
