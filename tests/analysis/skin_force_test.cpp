// The force of a punch, against closed forms and against the pressures below it; and what tension there is.
#include "explorer/analysis/skin_force.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <numbers>

#include "base/error.h"
#include "haptic/surface_stiffness.h"
#include "tests/interpolate/made_study.h"

namespace cleft {

TEST(PunchStiffness, OfAPunchOnAHalfSpaceIsSneddons) {
  for (const double nu : {0., 0.3, 0.5})
    for (const double radius : {1., 4.})
      EXPECT_NEAR(punch_stiffness({0.02, nu, 1000, 100, 0}, radius) * (1 - nu * nu) / (2 * radius * 0.02), 1,
                  6e-3)
          << nu;
}

namespace {

/// Of a disc of any radius under even pressure, by that of one of 2 mm on a layer of other size.
std::vector<double> disc_compliances(const SkinLayer& layer, double radius,
                                     const std::vector<double>& distances) {
  const double s = stiffness_radius / radius;
  std::vector<double> scaled = distances;
  for (double& distance : scaled) distance *= s;
  std::vector<double> sunk = layer_compliances(
      {layer.young_modulus, layer.poisson_ratio, layer.height * s, layer.foundation / s, layer.membrane * s},
      scaled);
  for (double& one : sunk) one /= s;
  return sunk;
}

/// Force over depth, by the pressures on rings whose middles all sink by the same.
double punch_by_rings(const SkinLayer& layer, double radius) {
  constexpr int rings = 16;
  std::vector<double> edges{0}, middles;
  for (int i = 1; i <= rings; ++i) {
    edges.push_back(radius * std::sin(std::numbers::pi / 2 * i /
                                      rings));  // denser at the rim, where the pressure is high
    middles.push_back((edges[edges.size() - 2] + edges.back()) / 2);
  }
  Eigen::MatrixXd sinks = Eigen::MatrixXd::Zero(rings, rings);
  Eigen::VectorXd areas(rings);
  for (int i = 0; i < rings; ++i) {
    const std::vector<double> of_disc =
        disc_compliances(layer, edges[static_cast<std::size_t>(i) + 1], middles);
    const Eigen::VectorXd column = Eigen::Map<const Eigen::VectorXd>(of_disc.data(), rings);
    sinks.col(i) += column;
    if (i + 1 < rings) sinks.col(i + 1) -= column;
    areas[i] = std::numbers::pi * (std::pow(edges[static_cast<std::size_t>(i) + 1], 2) -
                                   std::pow(edges[static_cast<std::size_t>(i)], 2));
  }
  return areas.dot(sinks.partialPivLu().solve(Eigen::VectorXd::Ones(rings)));
}

}  // namespace

TEST(PunchStiffness, OfAPunchIsThatOfTheForcesBelowIt) {
  // Skin on tissue; stiff skin on soft tissue; a thin layer on bone; a soft bed.
  for (const SkinLayer& layer : {SkinLayer{0.02, 0.4, 8, 0.005, 0.23}, SkinLayer{0.005, 0.45, 12, 0.002, 4},
                                 SkinLayer{0.1, 0.3, 6, 50, 0.1}, SkinLayer{0.3, 0.4, 8, 0.0005, 0.05}})
    for (const double radius : {1., 2.5, 5.}) {
      const double ratio = punch_stiffness(layer, radius) / punch_by_rings(layer, radius);
      EXPECT_NEAR(ratio, 1, 0.02) << radius << " " << layer.height;
    }
}

namespace {

RecordedParameters of_a_case() {
  RecordedParameters p = recorded(parameters_with({{"cut.depth", 3}, {"skin.prestress_v", 0.03}}));
  p.set("skin.edges", "held");
  return p;
}

}  // namespace

TEST(SkinForce, OfThePrestressIsThatOfSkinAndTissue) {
  RecordedParameters p = of_a_case();
  const SkinForce tension{SkinForce::Kind::tension};
  EXPECT_NEAR(tension.of(p), 0.03 * 1.5, 1e-12);
  p.set("tissue.prestress_share", 0.5);
  EXPECT_NEAR(tension.of(p), 0.03 * (1.5 + 0.5 * 3), 1e-12);
  p.set("skin.edges", "free");
  EXPECT_THROW(tension.of(p), InputError);
}

TEST(SkinForce, OfAPunchGrowsWithTheDentAndIsRefusedWhereItIsNotKnown) {
  RecordedParameters p = of_a_case();
  const auto punch = [](double dent) { return SkinForce{SkinForce::Kind::punch, dent, 3}; };
  EXPECT_NEAR(punch(2).of(p), 2 * punch(1).of(p), 1e-12);
  RecordedParameters on_bone = p;
  on_bone.set("patch.bottom", "bone");
  EXPECT_GT(punch(1).of(on_bone), punch(1).of(p));
  for (const auto& [name, value] : std::map<std::string, Value>{{"model", "finite"},
                                                                {"skin.initial_stress_stiffness", "true"},
                                                                {"skin.turning_stiffness", 0.5},
                                                                {"skin.bending_stiffness", 0.1},
                                                                {"patch.slope", 3.},
                                                                {"foundation.stiffness", 0.}}) {
    RecordedParameters other = p;
    other.set(name, value);
    EXPECT_THROW(punch(1).of(other), InputError) << name;
  }
}

}  // namespace cleft
