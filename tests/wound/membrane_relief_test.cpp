// How far cuts that do not meet relieve each other, against two collinear cracks in closed form: in a sheet
// without springs, between a < |x| < b, the opening has the slope
//   (x^2 - C^2) / sqrt((x^2 - a^2) (b^2 - x^2)),   C^2 = b^2 E(k) / K(k),   k^2 = 1 - a^2 / b^2,
// where that of a crack of half the length h alone has x / sqrt(h^2 - x^2) from its middle (Erdogan 1962).
#include "explorer/wound/membrane_relief.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "tests/incision/meshes.h"
#include "tests/wound/fields.h"

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
  return membrane_relief(cuts.all(), meetings(cuts.all()), blades);
}

std::vector<Vec3> line(double x0, double y0, double x1, double y1) { return {{x0, y0, 0}, {x1, y1, 0}}; }

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

TEST(MembraneRelief, IsNoneOfCutsThatMeetWhichRelieveEachOtherByTheirStrains) {
  const Field field = ellipses();
  for (const double gap : {-2., 0.5, 3., 4., 8.}) {  // between the end of one and the side of the other
    const double length_of_other = 15 - 0.1 - gap;
    const Cuts cuts(field, {line(-15, 0.1, 15, 0.1), line(0.1, 0.1 + gap, 0.1, 15)});
    EXPECT_EQ(meeting(*cuts.all()[0], *cuts.all()[1]), gap < 3.5 ? Meeting::close : Meeting::apart) << gap;
    const auto both = mutual_relief(cuts.all(), {length_of_other}).front(),
               met = relief_of_meeting_cuts(cuts.all(), length_of_other);
    for (const double s : {3., 12., 20.}) {
      if (gap < 3.5) EXPECT_EQ(both[0].at(s), met[0].at(s)) << gap;
      if (gap > 3.5) EXPECT_NE(both[0].at(s), met[0].at(s)) << gap;
    }
  }
}

/// Where they cross at a right angle their strains tell it, and no piece of skin draws back.
TEST(MembraneRelief, IsThatOfCutsThatCrossAtASlantAndTurnWithTheTension) {
  const Field field = ellipses();
  const auto crossing = [](double degrees) {
    const double angle = degrees * std::numbers::pi / 180, c = 15 * std::cos(angle), s = 15 * std::sin(angle);
    return std::vector{line(-15, 0.1, 15, 0.1), line(-c, 0.1 - s, c, 0.1 + s)};
  };
  for (const double degrees : {10., 30., 45., 60., 75., 89.}) {
    const Cuts own(field, crossing(degrees)), turned(turning(field), crossing(degrees));
    const bool slant = degrees > 25 && degrees < 80;
    EXPECT_EQ(meeting(*own.all()[0], *own.all()[1]), Meeting::close) << degrees;
    EXPECT_EQ(meeting(*turned.all()[0], *turned.all()[1]), slant ? Meeting::at_a_slant : Meeting::close)
        << degrees;
  }
  const Cuts turned(turning(field), crossing(45));
  const auto both = mutual_relief(turned.all(), {length}).front(), all = relief_of(turned, {length}).front();
  for (const double s : {4., 10., 15., 24.}) {
    EXPECT_NEAR(both[0].at(s), all[0].at(s), 1e-3) << s;
    EXPECT_LE(both[0].at(s), 1.1) << s;
  }
}

/// Lips lean away from the other cut on both of its sides, and where they cross not at all.
TEST(MembraneRelief, LipsThatLeanChangeSidesWhereCutsCross) {
  const Field field = ellipses();
  const Cuts cuts(turning(field), {line(-15, 0.1, 15, 0.1), line(-10, -9.9, 10, 10.1)});
  const Amplitude first = mutual_relief(cuts.all(), {20 * std::numbers::sqrt2}).front()[0];
  const double lean = first(10).lean;
  EXPECT_GT(std::abs(lean), 0.02);
  EXPECT_NEAR(first(20).lean, -lean, 0.05 * std::abs(lean));
  EXPECT_NEAR(first(15).lean, 0, 0.1 * std::abs(lean));
  for (double s = 12; s < 18; s += 0.1)
    EXPECT_LT(std::abs(first(s + 0.1).lean - first(s).lean), 0.2 * std::abs(lean)) << s;
}

TEST(MembraneRelief, WithACutOfEitherKindIsTheProduct) {
  const Field field = ellipses();
  const Cuts three(field, {line(-15, 0.1, 15, 0.1), line(0.1, -8, 0.1, 8), line(-15, 20.1, 15, 20.1)}),
      meeting(field, {line(-15, 0.1, 15, 0.1), line(0.1, -8, 0.1, 8)});
  const auto all = mutual_relief(three.all(), {length}).front();
  const auto met = relief_of_meeting_cuts(meeting.all(), 16);
  const auto apart = relief_of(three, {length}).front();
  for (const double s : {4., 10., 24.}) EXPECT_NEAR(all[0].at(s), met[0].at(s) * apart[0].at(s), 0.02) << s;
  EXPECT_LT(apart[0].at(15), 0.95);
}

}  // namespace
}  // namespace cleft
