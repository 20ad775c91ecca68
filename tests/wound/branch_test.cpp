// Where a cut leaves another one, its skin has two corners there, which part by themselves: the lip across
// stays whole.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "explorer/wound/corner_lean.h"
#include "explorer/wound/membrane_relief.h"
#include "explorer/wound/replayed_wounds.h"
#include "explorer/wound/shear_lean.h"
#include "tests/wound/fields.h"
#include "tests/wound/opened_cuts.h"

namespace cleft {
namespace {

using namespace testing;

const CanonicalCut canonical{-15, 30, 3};

Field evenly_pulled() {
  return in_tension(opening_field(canonical, 60, 60, 6, 3),
                    {{"skin.prestress_u", 0.03}, {"skin.prestress_v", 0.03}});
}

/// A cut along x, and one that leaves it.
class Branched {
 public:
  explicit Branched(double degrees)
      : along_{std::cos(degrees * std::numbers::pi / 180), std::sin(degrees * std::numbers::pi / 180), 0},
        wounds_(made_.open(field_, {line(-15, 0.1, 15, 0.1), line(0, 0, 16 * along_.x, 16 * along_.y)})) {}

  const Incision& main() const { return *made_.cuts[0]; }
  const Incision& branch() const { return *made_.cuts[1]; }
  const ReplayedWounds& wounds() const { return wounds_; }
  std::vector<const Wound*> both() const { return {&wounds_[0], &wounds_[1]}; }
  Crossing mouth() const { return crossings_of(both()).front(); }

  /// With the blade so far in the branch, mm.
  std::vector<Vec3> moved(double blade) const {
    std::vector<Vec3> now(wounds_.vertex_count());
    wounds_.positions(main().path().length() + blade, now);
    return now;
  }
  std::vector<Vec3> complete() const { return moved(branch().path().length()); }

  /// On the lip that the branch divides, nearest to its mouth: before and behind it.
  std::pair<int, int> corners() const {
    int before = -1, behind = -1;
    for (const Incision::ChainVertex& c : main().chain()) {
      if (c.s < mouth().s - 0.02) before = c.right;
      if (c.s > mouth().s + 0.02 && behind < 0) behind = c.right;
    }
    return {before, behind};
  }

 private:
  Field field_ = evenly_pulled();
  Vec3 along_;
  Made made_;
  ReplayedWounds wounds_;
};

TEST(Branch, ItsCornersAreApartInHeightAsTheirAnglesTell) {
  const Branched cuts(45);
  ASSERT_EQ(crossings_of(cuts.both()).size(), 1u);
  ASSERT_EQ(cuts.mouth().branch, 1);
  const double end = cuts.branch().path().length();
  const CornerLean lean =
      lean_at(cuts.mouth(), cuts.both(), end, membrane_relief(cuts.both(), {end}).front());
  const auto [u, time] = cuts.wounds()[0].volume.canonical(cuts.mouth().s, 30);
  const VaryingField& field = cuts.wounds()[0].field;
  const double alone = field.displacement({u, 0, 0}, Side::right, 30, 15).y -
                       field.displacement({u, 0, 0}, Side::left, 30, 15).y,
               apart = (lean.after - lean.before) * alone;
  ASSERT_GT(std::abs(apart), 0.1);
  // Of the lips next to the mouth, what is left of that there, and otherwise as further along the cut.
  const std::vector<Vec3> now = cuts.complete();
  const auto higher = [&](double from) {
    double nearest = 100, result = 0;
    for (const Incision::ChainVertex& c : cuts.main().chain())
      if (const double away = std::abs(c.s - cuts.mouth().s - from); away < nearest)
        nearest = away, result = now[c.right].z - now[c.left].z;
    return result;
  };
  for (const Incision::ChainVertex& c : cuts.main().chain()) {
    const double from = c.s - cuts.mouth().s, told = (from < 0 ? lean.before : lean.after) * alone;
    if (c.right != cuts.corners().first && c.right != cuts.corners().second) continue;
    EXPECT_NEAR(now[c.right].z - now[c.left].z,
                std::lerp(higher(std::copysign(3 * canonical.depth, from)), told, lean.at(from)), 0.01)
        << from;
  }
}

/// One lip cannot show a step where the other one has one.
TEST(Branch, TheLipAcrossStaysWhole) {
  const Branched cuts(50);
  const std::vector<Vec3> now = cuts.complete();
  double steepest = 0, step = 0, at = -1;
  Vec3 before;
  for (const Incision::ChainVertex& c : cuts.main().chain()) {
    if (std::abs(c.s - cuts.mouth().s) > 4) continue;
    const Vec3 moved = now[c.left] - cuts.wounds().rest()[c.left];
    if (at >= 0 && c.s > at) {
      step = std::max(step, norm(moved - before));
      steepest = std::max(steepest, norm(moved - before) / (c.s - at));
    }
    before = moved, at = c.s;
  }
  EXPECT_LT(steepest, 0.4);
  const auto [first, second] = cuts.corners();
  EXPECT_GT(norm((now[second] - cuts.wounds().rest()[second]) - (now[first] - cuts.wounds().rest()[first])),
            2 * step);
}

/// Skin that the blade has not cut yet has one place: with corners that part at once it was torn ahead.
TEST(Branch, NothingPartsAheadOfTheBlade) {
  for (const double degrees : {50., 130.}) {
    const Branched cuts(degrees);
    const double end = cuts.branch().path().length();
    for (const double part : {0.05, 0.2, 0.4, 0.5, 0.6, 0.8}) {
      const std::vector<Vec3> now = cuts.moved(part * end);
      for (const Incision::ChainVertex& c : cuts.branch().chain())
        if (c.s > part * end && c.s < end - canonical.depth)  // the guard holds what is next to the end
          EXPECT_LT(norm(now[c.right] - now[c.left]), 1e-9) << part << " " << c.s;
    }
  }
}

/// The corners are free when the blade has left the skin that moves with them, and part on the way from
/// there.
TEST(Branch, ItsCornersPartWhenTheBladeIsFarFromThem) {
  const Branched cuts(50);
  const auto free = [&](double blade) { return mutual_relief(cuts.both(), {blade}).front()[0].free.at(0); };
  const Crossing mouth = cuts.mouth();
  EXPECT_NEAR(mouth.fades, mouth.way * std::sin(50 * std::numbers::pi / 180), 1e-6);
  EXPECT_EQ(free(mouth.way), 0);
  EXPECT_NEAR(free(1.25 * mouth.way), 0.5, 1e-6);
  EXPECT_NEAR(free(1.5 * mouth.way), 1, 1e-6);
}

/// Of two that open into a cut from both sides each parts the lip on its own side. With corners that were
/// those of both lips, a branch tore the lip across from the mouth of another one, 8 mm away.
TEST(Branch, ThatFacesAnotherOnePartsItsOwnLipAlone) {
  const Field field = evenly_pulled();
  for (const double apart : {0.6, 2., 8.}) {
    Made made;
    const ReplayedWounds wounds(made.open(
        field, {line(-15, 0.1, 15, 0.1), line(-5, 0, -2, 16), line(apart - 5, 0.2, apart - 2, -16)}));
    const std::vector<const Wound*> all = {&wounds[0], &wounds[1], &wounds[2]};
    const Amplitude cut = mutual_relief(all, {wounds[2].complete()}).front()[0];
    ASSERT_EQ(cut.of_corners.size(), 2u);
    EXPECT_EQ(cut.free, std::vector<double>({1, 1}));
    for (const Crossing& mouth : crossings_of(all)) {
      const auto step = [&](const Amplitude& lip) {
        return std::abs(lip(mouth.behind()).lean - lip(mouth.before()).lean);
      };
      EXPECT_GT(step(cut.of_corners[mouth.side()]), 0.1) << apart;
      EXPECT_LT(step(cut.of_corners[1 - mouth.side()]), 1e-5) << apart;
    }
  }
}

/// The walls of the cut into which both open pass no shear from one to the other: its lips leaned by 0.2 of
/// what they open for one beyond the cut.
TEST(Branch, LeansForNoneBeyondTheCutThatItOpensInto) {
  const Field field = evenly_pulled();
  for (const double side : {-1., 1.}) {
    Made made;
    const ReplayedWounds wounds(made.open(
        field, {line(-15, 0.1, 15, 0.1), line(0, 0, 0, 16), line(4, 16 * side, 4, 0.1 - 0.1 * side)}));
    const std::vector<const Wound*> all = {&wounds[0], &wounds[1], &wounds[2]};
    ASSERT_TRUE(wounds[2].mouth_in(wounds[0]));
    ShearLean by_shear(all);
    std::size_t station = 0;
    for (const Incision::ChainVertex& c : made.cuts[1]->chain())
      if (c.left != c.right) by_shear.add({1, station++, c.s, 3, c.left, c.right});
    const ShearLean::Leans leans = by_shear.leans(16, membrane_relief(all, {16}).front());
    double by_cut = 0, by_branch = 0;
    for (std::size_t k = 0; k < station; ++k) {
      by_cut = std::max(by_cut, std::abs(leans[1][0][k]));
      by_branch = std::max(by_branch, std::abs(leans[1][2][k]));
    }
    EXPECT_GT(by_cut, 0.02);
    if (side > 0)
      EXPECT_GT(by_branch, 0.02);
    else
      EXPECT_EQ(by_branch, 0);
  }
}

/// Where a cut opens by nothing, what a branch moves its lips by is over nothing.
TEST(Branch, MovesTheEndsOfItsCutAsTheSkinBesideThem) {
  const Branched cuts(50);
  const Amplitude main = mutual_relief(cuts.both(), {cuts.branch().path().length()}).front()[0];
  for (const double end : {0., 30.}) {
    const double inside = end == 0 ? 0.6 : 29.4;
    EXPECT_NEAR(main(end).value, main(inside).value, 0.03);
    EXPECT_NEAR(main(end).shift, main(inside).shift, 0.03);
  }
}

}  // namespace
}  // namespace cleft
