// How stiff skin is, against closed forms; tests/pipeline compares with the solver.
#include <gtest/gtest.h>

#include <numbers>

#include "base/error.h"
#include "haptic/surface_stiffness.h"
#include "tests/incision/fields.h"

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

TEST(Stiffness, OfAFieldGrowsWithTheSkinAndTheBed) {
  Field field = testing::opening_field({-10, 20, 4}, 40, 30, 8, 4);
  EXPECT_THROW(surface_stiffness(field), InputError);
  field.parameters = {{"tissue.young_modulus", 0.02}, {"tissue.poisson_ratio", 0.4}};
  const double half_space = surface_stiffness(field);
  EXPECT_NEAR(half_space, pi * a * 0.02 / (2 * (1 - 0.16)), 1e-12);
  field.parameters.insert({{"patch.height", 8},
                           {"foundation.stiffness", 0.005},
                           {"skin.young_modulus", 0.13},
                           {"skin.poisson_ratio", 0.4},
                           {"skin.thickness", 1.5}});
  const double layer = surface_stiffness(field);
  EXPECT_GT(layer, half_space);
  field.parameters["foundation.stiffness"] = 0.5;
  EXPECT_GT(surface_stiffness(field), layer);
}

}  // namespace
}  // namespace cleft
