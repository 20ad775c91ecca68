// How stiff skin is, against closed forms; tests/pipeline compares with the solver.
#include <gtest/gtest.h>

#include <numbers>

#include "base/error.h"
#include "haptic/firmness_above_bone.h"
#include "haptic/surface_dent.h"
#include "haptic/surface_stiffness.h"
#include "tests/support/recorded.h"
#include "tests/wound/fields.h"

namespace cleft {
namespace {

constexpr double a = stiffness_radius, pi = std::numbers::pi;

TEST(Stiffness, OfADeepLayerIsThatOfAHalfSpace) {
  // What lies below H sinks by about a / H of the whole: 2 / 1000.
  for (const double nu : {0., 0.3, 0.5}) {
    const double half_space = 2 * a * (1 - nu * nu) / 0.02;
    EXPECT_NEAR(layer_compliance({0.02, nu, 1000, 100, 0}) / half_space, 1, 3e-3) << nu;
  }
}

TEST(Stiffness, OfAThinLayerOnARigidBedIsItsOwn) {
  // A disc 40 times as wide as the layer is high presses it in a column: H / M, M = E (1 - nu) / ((1 + nu) (1
  // - 2 nu)). In its middle the rim is not felt.
  const double nu = 0.25, m = 0.02 * (1 - nu) / ((1 + nu) * (1 - 2 * nu));
  EXPECT_NEAR(layer_compliance({0.02, nu, 0.05, 1e6, 0}) / (0.05 / m), 1, 0.01);
}

TEST(Stiffness, SkinThatCannotSlipIsAsStiffAsTheory) {
  // A half space whose surface moves only up and down sinks under a force P by (1 + nu) (3 - 4 nu) P / (4 pi
  // E (1 - nu) r), in place of (1 - nu^2) P / (pi E r).
  const double nu = 0.3;
  const double free = (1 - nu * nu), held = (1 + nu) * (3 - 4 * nu) / (4 * (1 - nu));
  EXPECT_NEAR(layer_compliance({0.02, nu, 1000, 100, 1e6}) / (2 * a / 0.02 * held), 1, 3e-3);
  EXPECT_LT(held, free);
}

TEST(Stiffness, OfOneTissueInSeveralLayersIsThatOfTheWhole) {
  const double whole = layer_compliance({0.02, 0.4, 8, 0.005, 0.23});
  EXPECT_NEAR(layer_compliance({0.02, 0.4, 3, 0.005, 0.23, {{0.02, 0.4, 1}, {0.02, 0.4, 4}}}) / whole, 1,
              1e-9);
}

TEST(Stiffness, OfThinLayersOnARigidBedIsTheirSum) {
  // As that of a thin layer on a rigid bed: columns H / M one on the other.
  const auto column = [](double e, double nu, double h) {
    return h * (1 + nu) * (1 - 2 * nu) / (e * (1 - nu));
  };
  const double sum = column(0.02, 0.25, 0.05) + column(0.1, 0.3, 0.04);
  EXPECT_NEAR(layer_compliance({0.02, 0.25, 0.05, 1e6, 0, {{0.1, 0.3, 0.04}}}) / sum, 1, 0.01);
}

TEST(Stiffness, OfABodyIsThatOfItsTissue) {
  Field field = testing::opening_field({-10, 20, 4}, 40, 30, 8, 4);
  field.parameters = recorded(testing::skin_on_springs());
  const double of_case = surface_stiffness(field);
  field.tissue = TissueBelow{{{0.02, 0.4, 8}}, 0.005};
  EXPECT_NEAR(surface_stiffness(field), of_case, 1e-9);
  field.tissue = TissueBelow{{{0.02, 0.4, 5}}, 2.5};  // on bone
  EXPECT_GT(surface_stiffness(field), 1.2 * of_case);
}

TEST(Stiffness, AboveBoneIsThatOfABodyThere) {
  Field field = testing::opening_field({-10, 20, 4}, 40, 30, 8, 4);
  EXPECT_EQ(FirmnessAboveBone(field).at(1), 1) << "nothing is known of it";
  field.parameters = recorded(testing::skin_on_springs());
  const double of_case = surface_stiffness(field);
  const FirmnessAboveBone firmness(field);
  EXPECT_NEAR(firmness.at(8), 1, 1e-12);
  EXPECT_NEAR(firmness.at(INFINITY), 1, 1e-12);
  const double bone = 1000 * 0.02 / 8;
  for (const double tissue : {0.7, 2.2, 5., 7.9}) {
    field.tissue = TissueBelow{{{0.02, 0.4, tissue}}, bone};
    EXPECT_NEAR(firmness.at(tissue) * of_case / surface_stiffness(field), 1, 2e-3) << tissue;
  }
  EXPECT_GT(firmness.at(2.2), 2);
  EXPECT_EQ(firmness.at(0), firmness.at(0.4));
  // A body on bone itself: layers, and where there is none, thicker and on springs.
  field.tissue = TissueBelow{{{0.08, 0.4, 1}, {0.02, 0.4, 3}}, bone};
  const double of_body = surface_stiffness(field);
  const FirmnessAboveBone layered(field);
  EXPECT_NEAR(layered.at(4), 1, 2e-3);
  field.tissue = TissueBelow{{{0.08, 0.4, 2}, {0.02, 0.4, 6}}, 0.005};
  EXPECT_NEAR(layered.at(9) * of_body / surface_stiffness(field), 1, 1e-9);
}

TEST(Stiffness, OfAFieldGrowsWithTheSkinAndTheBed) {
  Field field = testing::opening_field({-10, 20, 4}, 40, 30, 8, 4);
  EXPECT_THROW(surface_stiffness(field), InputError);
  std::map<std::string, double> known = {{"tissue.young_modulus", 0.02}, {"tissue.poisson_ratio", 0.4}};
  field.parameters = recorded(known);
  const double half_space = surface_stiffness(field);
  EXPECT_NEAR(half_space, pi * a * 0.02 / (2 * (1 - 0.16)), 1e-12);
  known.insert({{"patch.height", 8},
                {"foundation.stiffness", 0.005},
                {"skin.young_modulus", 0.13},
                {"skin.poisson_ratio", 0.4},
                {"skin.thickness", 1.5}});
  field.parameters = recorded(known);
  const double layer = surface_stiffness(field);
  EXPECT_GT(layer, half_space);
  field.parameters.set(field.parameters->foundation.stiffness, 0.5);
  EXPECT_GT(surface_stiffness(field), layer);
}

/// Of even pressure on a disc of radius a, by sums over rings and sectors of 1 / distance, over that in its
/// middle: (1 / 2 pi a) times the integral of dA / distance.
double sunk_by_sums(double disc, double distance) {
  constexpr int rings = 2000, sectors = 2001;
  double sum = 0;
  for (int i = 0; i < rings; ++i)
    for (int j = 0; j < sectors; ++j) {
      const double r = disc * (i + 0.5) / rings, angle = 2 * std::numbers::pi * j / sectors;
      sum += r * disc / rings * 2 * std::numbers::pi / sectors /
             std::hypot(r * std::cos(angle) - distance, r * std::sin(angle));
    }
  return sum / (2 * std::numbers::pi * disc);
}

TEST(Dent, IsThatOfAHalfSpaceUnderADisc) {
  const SurfaceDent dent;
  EXPECT_NEAR(dent.at(0), 1, 1e-12);
  EXPECT_NEAR(dent.at(2), 2 / std::numbers::pi * (1 - 2 * 4. / 900), 1e-4) << "on the rim: 2 / pi";
  for (const double r : {0.7, 3.1, 6.3}) {
    const double to_nothing = std::pow(1 - r * r / 900, 2);
    EXPECT_NEAR(dent.at(r) / to_nothing, sunk_by_sums(2, r), 2e-3) << r;
  }
  EXPECT_EQ(dent.at(30), 0);
}

TEST(Dent, OfAStiffLayerOnASoftBedIsThatOfAPlate) {
  // Kirchhoff's plate on Winkler's bed under the disc: p a times the integral of J1(a x) J0(r x) / (D x^4 +
  // k). The layer's shear adds about (h / l)^2 = 0.4 %, l = (D / k)^(1/4) = 16 mm; the press under the disc
  // 0.1 %.
  const double e = 10, nu = 0.3, h = 1, k = 1.4e-5, d = e * h * h * h / (12 * (1 - nu * nu));
  const std::vector<double> distances{0, 5, 12, 25};
  const auto sunk = layer_compliances({e, nu, h, k, 0}, distances);
  for (std::size_t n = 0; n < distances.size(); ++n) {
    double plate = 0;
    constexpr int pieces = 20000;
    constexpr double farthest = 3;  // 1/mm
    for (int i = 0; i < pieces; ++i) {
      const double x = farthest * (i + 0.5) / pieces;
      plate += a * std::cyl_bessel_j(1., a * x) * std::cyl_bessel_j(0., distances[n] * x) /
               (d * x * x * x * x + k) * farthest / pieces;
    }
    EXPECT_NEAR(sunk[n] / plate, 1, 0.01) << distances[n];
  }
  // So wide a dent is what a picture of it shows: nearly all of it at the disc's rim, where a half space has
  // 2 / pi.
  EXPECT_GT(SurfaceDent(SkinLayer{e, nu, h, k, 0}).at(2), 0.95);
}

}  // namespace
}  // namespace cleft
