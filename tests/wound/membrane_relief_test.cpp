// How far cuts relieve each other, against two collinear cracks in closed form: in a sheet
// without springs, between a < |x| < b, the opening has the slope
//   (x^2 - C^2) / sqrt((x^2 - a^2) (b^2 - x^2)),   C^2 = b^2 E(k) / K(k),   k^2 = 1 - a^2 / b^2,
// where that of a crack of half the length h alone has x / sqrt(h^2 - x^2) from its middle (Erdogan 1962).
#include "explorer/wound/membrane_relief.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <numeric>

#include "explorer/wound/corner_lean.h"
#include "explorer/wound/replayed_wounds.h"
#include "tests/incision/meshes.h"
#include "tests/wound/fields.h"
#include "tests/wound/opened_cuts.h"

namespace cleft {
namespace {

using namespace testing;

const CanonicalCut canonical{-15, 30, 3};
constexpr double length = 30, piece = length / 24;  // mm

/// The same in the tension at each place of the path.
VaryingField turning(const Field& field) { return {{&field}, {0}, {{1}}}; }

/// Opens as an ellipse does, in proportion to the length that is cut: as in a sheet without springs.
Field ellipses() { return in_tension(opening_field(canonical, 50, 50, 6, 3), {{"skin.prestress_v", 0.03}}); }

/// Straight cuts in a flat mesh, one after the other.
class Cuts {
 public:
  Cuts(const VaryingField& field, const std::vector<std::vector<Vec3>>& paths)
      : mesh_(grid(60, 40, -60.3, -40.1, 2)) {
    IncisionOptions options;
    options.max_edge = 0;
    for (const auto& path : paths) {
      made_.push_back(std::make_unique<Incision>(mesh_, path_through(path, up, 3), options));
      made_.back()->advance_to(made_.back()->path().length());
    }
    for (const auto& cut : made_) wounds_.push_back(std::make_unique<Wound>(*cut, field, 1));
  }

  std::vector<const Wound*> all() const {
    std::vector<const Wound*> result;
    for (const auto& wound : wounds_) result.push_back(wound.get());
    return result;
  }

 private:
  CutMesh mesh_;
  std::vector<std::unique_ptr<Incision>> made_;
  std::vector<std::unique_ptr<Wound>> wounds_;
};

std::vector<std::vector<Amplitude>> relief_of(const Cuts& cuts, const std::vector<double>& blades) {
  return membrane_relief(cuts.all(), blades);
}

/// The opening of one of two collinear cracks over that of it alone, at x between a and b.
double collinear_ratio(double a, double b, double x) {
  const double k = std::sqrt(1 - a * a / (b * b)), c2 = b * b * std::comp_ellint_2(k) / std::comp_ellint_1(k);
  // From b inward, with x = m + h cos(angle): both root singularities go.
  const double m = (a + b) / 2, h = (b - a) / 2, end = std::acos((x - m) / h);
  constexpr int parts = 4000;
  double opening = 0;
  for (int i = 0; i < parts; ++i) {
    const double at = m + h * std::cos(end * (i + 0.5) / parts);
    opening += end / parts * (at * at - c2) / std::sqrt((at + a) * (b + at));
  }
  return opening / std::sqrt(h * h - (x - m) * (x - m));
}

TEST(MembraneRelief, OfCollinearCutsIsThatOfCollinearCracks) {
  const Field field = ellipses();
  for (const double a : {2., 5., 12.}) {  // half the distance of their ends
    const double b = a + length;
    const Cuts cuts(field, {line(-b, 0.1, -a, 0.1), line(a, 0.1, b, 0.1)});
    const auto found = relief_of(cuts, {length});
    ASSERT_EQ(found.size(), 1u);
    // The jump is constant over a piece: the nearer the ends, the more it matters where a piece ends.
    const double tolerance = 0.1 * piece / (2 * a);
    for (const double x : {a + 2, a + 8, a + 15, a + 22, a + 28}) {
      const double expected = collinear_ratio(a, b, x);
      EXPECT_NEAR(found[0][1].at(x - a), expected, tolerance) << "a = " << a << ", x = " << x;
      EXPECT_NEAR(found[0][0].at(b - x), expected, tolerance) << "a = " << a << ", x = " << -x;
    }
  }
  EXPECT_GT(collinear_ratio(2, 32, 4), 1.2) << "ratios that are all 1 would show nothing";
}

TEST(MembraneRelief, WithHalfOfTheLastCutIsThatOfACutOfHalfTheLength) {
  const Field field = ellipses();
  const Cuts whole(field, {line(-15, -4, 15, -4), line(-15, 4, 15, 4)}),
      half(field, {line(-15, -4, 15, -4), line(-15, 4, 0, 4)});
  const auto growing = relief_of(whole, {0, 15, 30}), cut = relief_of(half, {15});
  for (const double s : {1., 4., 9., 14.}) {
    EXPECT_NEAR(growing[1][0].at(s), cut[0][0].at(s), 1e-6) << s;
    EXPECT_NEAR(growing[1][1].at(s), cut[0][1].at(s), 1e-6) << s;
    EXPECT_NEAR(growing[0][0].at(s), 1, 1e-9) << s;  // nothing of the other is cut
    EXPECT_LT(growing[2][0].at(s), growing[1][0].at(s)) << s;
    EXPECT_NEAR(growing[2][0].at(s), growing[2][1].at(s), 1e-6) << s;  // alike
    // The strip between them becomes longer: its lips, at v > 0 of the first cut and at v < 0 of the other,
    // shift toward the ends.
    const double shift = growing[2][0](s).shift;
    EXPECT_LT(shift, 0) << s;
    EXPECT_NEAR(growing[2][0](length - s).shift, -shift, 1e-6) << s;
    EXPECT_NEAR(growing[2][1](s).shift, -shift, 1e-6) << s;
  }
}

/// The corner between a cut and one that begins on it is thin. How it moves changes with its angle as little
/// as the angle does: no angle is one at which elements of the cuts hold it less than at the next.
TEST(MembraneRelief, OfACutThatLeavesAnotherChangesLittleWithTheAngle) {
  const Field field = ellipses();
  std::vector<double> at_start;
  for (double degrees = 32; degrees <= 46; degrees += 0.5) {
    const double angle = degrees * std::numbers::pi / 180;
    const Cuts cuts(turning(field),
                    {line(-15, 0, 15, 0), line(0.3, 0, 0.3 + 15 * std::cos(angle), 15 * std::sin(angle))});
    at_start.push_back(relief_of(cuts, {15}).front()[1](0.3).shift);
  }
  for (std::size_t i = 1; i + 1 < at_start.size(); ++i)
    EXPECT_NEAR(at_start[i], std::midpoint(at_start[i - 1], at_start[i + 1]), 0.005) << 32 + 0.5 * i;
}

/// A cut that leaves another one in its middle, and one that ends just before it.
TEST(MembraneRelief, OfACutThatLeavesAnotherIsOpenAtItsStart) {
  const Field field = opening_field(canonical, 60, 60, 6, 3);
  const Field pulled = in_tension(field, {{"skin.prestress_v", 0.03}});
  Made made;
  std::vector<Wound> opened = made.open(pulled, {line(-15, 0.1, 15, 0.1), line(0, 0, 0, 16)});
  const Incision *main = made.cuts[0].get(), *branch = made.cuts[1].get();
  ASSERT_TRUE(opened[1].opens_into(opened[0], false));
  EXPECT_FALSE(opened[0].opens_into(opened[1], false));
  const ReplayedWounds wounds(std::move(opened));
  ASSERT_EQ(wounds[1].volume.mouth(false)->earlier, main);
  std::vector<Vec3> now(wounds.vertex_count());
  wounds.positions(wounds.duration(), now);
  // The lips of the branch are apart at its start as they are a depth from there.
  std::vector<double> apart;
  for (const auto& c : branch->chain())
    if (c.s > 0.2 && c.s < 6) apart.push_back(norm(now[c.right] - now[c.left]));
  ASSERT_GT(apart.size(), 4u);
  for (const double one : apart) EXPECT_NEAR(one, apart.back(), 0.25 * apart.back());
  EXPECT_GT(apart.back(), 0.5);
  // The lip beyond stays whole.
  double before = 0;
  bool first = true;
  for (const auto& c : main->chain()) {
    if (c.s < 10 || c.s > 20) continue;
    const double along = now[c.left].x - made.mesh.position(c.left).x, here = made.mesh.position(c.left).x;
    if (!first) EXPECT_GT(here + along, before);
    before = here + along, first = false;
  }
  // Nothing of it is open before it is cut.
  const auto growing = membrane_relief({&wounds[0], &wounds[1]}, {0, 16});
  for (const double s : {0., 1., 8.}) EXPECT_EQ(growing[0][1].at(s), 0);
  EXPECT_GT(growing[1][1].at(0), 0.3);
}

/// The same the other way: it is closed until the blade comes to the other cut, and then opens as one that
/// leaves it; in between continuously.
TEST(MembraneRelief, OfACutThatEndsInAnotherIsOpenAtItsEndWhenTheBladeIsThere) {
  const Field pulled = in_tension(opening_field(canonical, 60, 60, 6, 3), {{"skin.prestress_v", 0.03}});
  Made made;
  std::vector<Wound> opened = made.open(pulled, {line(-15, 0.1, 15, 0.1), line(0, 16, 0, 0)});
  ASSERT_TRUE(opened[1].opens_into(opened[0], true));
  EXPECT_FALSE(opened[1].opens_into(opened[0], false));
  const ReplayedWounds wounds(std::move(opened));
  const OpenedTo opened_to = wounds[1].volume.opened_to();
  EXPECT_NEAR(opened_to.end, 15.9, 1e-6);
  EXPECT_NEAR(opened_to(16), 15.9 + 3, 1e-6);
  const double before = opened_to.begins();
  EXPECT_EQ(opened_to(before), before);
  std::vector<Vec3> now(wounds.vertex_count());
  const auto apart = [&](const Incision::ChainVertex& c) { return norm(now[c.right] - now[c.left]); };
  const Incision &main = *made.cuts[0], &branch = *made.cuts[1];
  // Before it arrives its front is closed.
  wounds.positions(30 + before, now);
  for (const auto& c : branch.chain())
    if (c.s > before) EXPECT_LT(apart(c), 1e-9) << c.s;
  // And then its lips are apart at its end as they are a depth from there.
  wounds.positions(wounds.duration(), now);
  std::vector<double> complete;
  for (const auto& c : branch.chain())
    if (c.s > 10 && c.s < 15.8) complete.push_back(apart(c));
  ASSERT_GT(complete.size(), 4U);
  for (const double one : complete) EXPECT_NEAR(one, complete.front(), 0.25 * complete.front());
  EXPECT_GT(complete.back(), 0.5);
  std::vector<double> way;  // of the lip beyond, which stays whole
  for (const auto& c : main.chain())
    if (c.s > 10 && c.s < 20) way.push_back(now[c.right].x);
  EXPECT_TRUE(std::ranges::is_sorted(way));
  // In between nothing jumps.
  constexpr int steps = 100;
  std::vector<Vec3> last(wounds.vertex_count());
  wounds.positions(30 + before, last);
  for (int i = 1; i <= steps; ++i) {
    wounds.positions(30 + before + (16 - before) * i / steps, now);
    double most = 0;
    for (std::size_t v = 0; v < now.size(); ++v) most = std::max(most, norm(now[v] - last[v]));
    EXPECT_LT(most, 0.15 * complete.back()) << i;
    std::swap(now, last);
  }
}

/// Where the mesh has a bridge of skin before the other cut, nothing opens on.
TEST(MembraneRelief, OfACutThatStopsBeforeAnotherStaysClosedAtItsEnd) {
  const Field pulled = in_tension(opening_field(canonical, 60, 60, 6, 3), {{"skin.prestress_v", 0.03}});
  CutMesh mesh(grid(60, 40, -60.3, -40.1, 2));
  Incision main(mesh, path_through(line(-15, 0.1, 15, 0.1), up, 3), IncisionOptions{});
  main.advance_to(30);
  Incision branch(mesh, path_through(line(0, 16, 0, 0.1), up, 3), IncisionOptions{});
  branch.advance_to(15.4);
  Wound of_main(main, pulled, 1), of_branch(branch, pulled, 1);
  ASSERT_TRUE(of_branch.opens_into(of_main, true));
  of_branch.volume.opens_into(main, true);
  EXPECT_GT(of_branch.volume.opened_to().runs_on, 0) << "it may come there yet";
  branch.advance_to(15.89);
  EXPECT_EQ(of_branch.volume.opened_to().runs_on, 0) << branch.tip();
}

/// Where a cut is crossed its pieces end, wherever that is: where it was within a piece, the piece felt the
/// other cut as much as it is singular there.
TEST(MembraneRelief, OfCutsThatCrossChangesLittleWithThePlaceWhereTheyDo) {
  const Field field = ellipses();
  const double c = std::cos(std::numbers::pi / 3), s = std::sin(std::numbers::pi / 3);
  std::vector<Amplitude> before;
  for (int i = 0; i <= 8; ++i) {
    const double x = 4 + i * piece / 8;  // where they cross
    const Cuts cuts(turning(field),
                    {line(-15, 0.1, 15, 0.1), line(x - 6 * c, 0.1 - 6 * s, x + 14 * c, 0.1 + 14 * s)});
    const std::vector<Amplitude> now = relief_of(cuts, {20}).front();
    if (i > 0)
      for (const double way : {-5., -2., 2., 5., 8.}) {
        EXPECT_NEAR(now[0].at(15 + x + way), before[0].at(15 + x - piece / 8 + way), 0.02)
            << x << ", " << way;
        EXPECT_NEAR(now[1].at(6 + way), before[1].at(6 + way), 0.02) << x << ", " << way;
      }
    // The short end of the other cut hardly opens the part of this one that it leaves.
    EXPECT_GT(now[0].at(15 + x - 3), now[0].at(15 + x + 3) + 0.05) << x;
    for (const double value : now[0].values) EXPECT_LE(value, 1.1) << x;
    before = now;
  }
}

TEST(MembraneRelief, IsOneOfFieldsThatDoNotOpen) {
  const Field closed = in_tension(opening_field(canonical, 50, 50, 6, 0), {{"skin.prestress_v", 0.03}});
  const Cuts cuts(closed, {line(-15, -4, 15, -4), line(-15, 4, 15, 4)});
  const std::vector<std::vector<Amplitude>> found = relief_of(cuts, {length});
  for (const Amplitude& one : found.front()) EXPECT_EQ(one.at(10), 1);
}

/// Cuts that touch feel each other through another membrane than cuts apart, in which each opens more: on
/// cuts apart, one that is crossed acts as one that is not. It acted by more.
TEST(MembraneRelief, OfACutBesideAnotherIsTheSameWhenThatOneIsCrossed) {
  const Field field = in_tension(opening_field(canonical, 50, 50, 6, 3, 0.8), {{"skin.prestress_v", 0.03}});
  const std::vector<Vec3> first = line(-15, -4, 15, -4), second = line(-15, 4, 15, 4);
  const Cuts two(turning(field), {first, second});
  const Amplitude beside_one = relief_of(two, {length}).front()[0];
  const Cuts crossed(turning(field), {first, second, line(14.9, 2, 14.9, 12)});  // by a cut in no tension
  const Amplitude beside_two = relief_of(crossed, {10}).front()[0];
  for (const double s : {2., 8., 15., 22.}) {
    EXPECT_LT(beside_one.at(s), 0.8) << s;
    EXPECT_NEAR(beside_two.at(s), beside_one.at(s), 0.02) << s;
  }
}

/// Lips lean away from the other cut on both of its sides, and less where they cross.
TEST(MembraneRelief, LipsThatLeanChangeSidesWhereCutsCross) {
  const Field field = ellipses();
  const Cuts cuts(turning(field), {line(-15, 0.1, 15, 0.1), line(-10, -9.9, 10, 10.1)});
  const Amplitude first = mutual_relief(cuts.all(), {20 * std::numbers::sqrt2}).front()[0];
  const double lean = first(10).lean;
  EXPECT_GT(std::abs(lean), 0.02);
  EXPECT_NEAR(first(20).lean, -lean, 0.25 * std::abs(lean));  // stations are 2 mm apart
  EXPECT_LT(std::abs(first(15).lean), 0.7 * std::abs(lean));
}

/// Both cuts part the corners: of two that face each other the lips rise, and of the others they sink.
TEST(MembraneRelief, CornersOfACrossingLeanAsTheirAnglesTell) {
  const Field field = ellipses();
  Made made;
  std::vector<Wound> opened = made.open(turning(field), {line(-15, 0.1, 15, 0.1), line(-10, -9.9, 10, 10.1)});
  const std::vector<const Wound*> both = {&opened[0], &opened[1]};
  const double end = made.cuts[1]->path().length();
  const auto crossing = crossings_of(both).back();
  ASSERT_EQ(crossing.cut, 1u);
  const double lean = lean_at(crossing, both, end, membrane_relief(both, {end}).front()).before,
               alone = field.displacement({0, 0, 0}, Side::right, length).y -
                       field.displacement({0, 0, 0}, Side::left, length).y;
  ASSERT_GT(std::abs(lean * alone), 0.05);
  const ReplayedWounds wounds(std::move(opened));
  std::vector<Vec3> now(wounds.vertex_count());
  wounds.positions(wounds.duration(), now);
  std::vector<double> corners, further;  // right above left, at the crossing and 4 mm and more behind it
  for (const auto& c : made.cuts[1]->chain()) {
    const double from = c.s - 10 * std::numbers::sqrt2, higher = now[c.right].z - now[c.left].z;
    if (std::abs(from) < 0.02) corners.push_back(higher);
    if (from > 4 && from < 6) further.push_back(std::abs(higher));
  }
  ASSERT_EQ(corners.size(), 2u);
  ASSERT_FALSE(further.empty());
  ASSERT_GT(further.front(), 3 * std::abs(lean * alone));
  for (const double corner : corners)
    EXPECT_NEAR(std::abs(corner), std::abs(lean * alone), 0.1 * std::abs(lean * alone));
  EXPECT_LT(corners[0] * corners[1], 0);
}

/// A cut that opens less on one side of another one than on the other side parts the corners between them.
/// They parted before the blade came by, and lips passed each other.
TEST(MembraneRelief, CornersOfACrossingDoNotPartBeforeTheBladeHasPassed) {
  const Field field = ellipses();
  const Cuts cuts(turning(field), {line(-15, 0.1, 15, 0.1), line(-14, -6.9, 14, 7.1)});
  const Crossing crossing = crossings_of(cuts.all()).front();
  ASSERT_EQ(crossing.cut, 0u);
  const Relief relief = relief_while_cut(cuts.all());
  const double end = cuts.all()[1]->felt();
  const auto parted = [&](double blade) {
    const Relief::At now = relief.at(blade / end);
    double most = 0;
    for (const double away : {-1., -0.5, 0.5, 1.})
      most = std::max(most, std::abs(now.amplitude(0, crossing.s + away * crossing.fades) -
                                     now.amplitude(0, crossing.s)));
    return most;
  };
  for (const double way : {3., 1., 0.3, 0.})
    EXPECT_LT(parted(crossing.other_s - way), 1e-6) << way << " mm before";
  EXPECT_GT(parted(crossing.other_s + 1), 0.003);
  EXPECT_GT(parted(crossing.other_s + 3), 2 * parted(crossing.other_s + 1));
}

/// A later cut moves the walls of an earlier one as the lips above them: it moved the lips alone.
TEST(MembraneRelief, WallsOfACutAreBesideALaterOneAsTheirLipsAre) {
  const Field field = ellipses();
  Made made;
  const std::vector<Wound> opened =
      made.open(turning(field), {line(-15, 0.1, 15, 0.1), line(-10, -9.9, 10, 10.1)});
  const IncisionVolume& later = opened[1].volume;
  std::map<std::pair<double, Side>, int> lip;  // of the first cut, by s
  for (const auto& c : made.cuts[0]->chain())
    lip[{c.s, Side::left}] = c.left, lip[{c.s, Side::right}] = c.right;
  int compared = 0;
  const auto count = static_cast<int>(made.mesh.vertices().size());
  for (int v = 0; v < count; ++v) {
    const CutMesh::Vertex& vertex = made.mesh.vertex(v);
    const auto above = lip.find({vertex.s, side_of(vertex.kind)});
    if (vertex.cut != made.cuts[0]->cut() || !(vertex.depth > 0) || above == lip.end()) continue;
    const auto wall = later.locate(v), top = later.locate(above->second);
    ASSERT_EQ(wall.has_value(), top.has_value()) << vertex.s;
    if (!wall || std::abs(vertex.position.x) < 0.2) continue;  // corners are on both sides
    EXPECT_EQ(wall->side, top->side) << vertex.s;
    EXPECT_NEAR(wall->uvw.x, top->uvw.x, 1e-9);
    EXPECT_NEAR(wall->uvw.y, top->uvw.y, 1e-9);
    EXPECT_NEAR(wall->uvw.z, -vertex.depth, 1e-9);
    ++compared;
  }
  EXPECT_GT(compared, 100);
}

/// A vertex is bounded by what all of them move it by, whichever cuts cross an earlier one when.
TEST(MembraneRelief, NothingMovesFurtherThanItsBoundWhereCutsCross) {
  const Field field = ellipses();
  Made made;
  const ReplayedWounds wounds(
      made.open(turning(field), {line(-15, 0.1, 15, 0.1), line(-10, -9.9, 2, 2.1), line(2, -6, 14, 6)}));
  std::vector<Vec3> all(wounds.vertex_count()), few(wounds.vertex_count());
  const double detail = 0.05;
  const auto level = wounds.level(detail);
  EXPECT_GT(level.left_out(), 0u);
  for (const double part : {0.3, 0.6, 0.8, 1.}) {
    wounds.positions(part * wounds.duration(), all);
    std::copy(wounds.rest().begin(), wounds.rest().end(), few.begin());
    wounds.positions(part * wounds.duration(), level, few);
    for (std::size_t v = 0; v < all.size(); ++v) ASSERT_LE(norm(all[v] - few[v]), detail + 1e-9) << v;
  }
}

}  // namespace
}  // namespace cleft
