// The laws of finite strains: forces and tangents against differences of energies and forces, the state at
// the reference, independence of rotations, and closed forms.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <random>

#include "solver/material/fung_skin.h"
#include "solver/material/isotropic_skin.h"
#include "solver/material/linear_isotropic.h"
#include "solver/material/neo_hookean_skin.h"
#include "solver/material/neo_hookean_tissue.h"
#include "solver/material/st_venant_kirchhoff_skin.h"
#include "solver/material/st_venant_kirchhoff_tissue.h"

namespace cleft {

namespace {

using Displacements = FiniteTissue::Displacements;
using Vector18 = Eigen::Matrix<double, 18, 1>;
using Matrix18 = Eigen::Matrix<double, 18, 18>;

/// A wedge with slanting edges, whose gradients differ between its points.
std::vector<ReferencePoint> points_of_a_wedge() {
  Eigen::Matrix<double, 3, 6> corners;
  corners << 0, 1.1, 0.1, -0.05, 1, 0.2,  //
      0, 0.1, 0.9, 0.1, -0.1, 1,          //
      0, 0.05, -0.1, 0.8, 1, 0.9;
  std::vector<ReferencePoint> points;
  for (const double c : {-1 / std::sqrt(3), 1 / std::sqrt(3)})
    for (const auto& [a, b] : {std::pair(1. / 6, 1. / 6), {2. / 3, 1. / 6}, {1. / 6, 2. / 3}}) {
      Eigen::Matrix<double, 6, 3> slope;
      const Eigen::Vector3d shape(1 - a - b, a, b);
      const double along[3][2] = {{-1, -1}, {1, 0}, {0, 1}};
      for (int i = 0; i < 3; ++i) {
        slope.row(i) << along[i][0] * (1 - c) / 2, along[i][1] * (1 - c) / 2, -shape[i] / 2;
        slope.row(3 + i) << along[i][0] * (1 + c) / 2, along[i][1] * (1 + c) / 2, shape[i] / 2;
      }
      const Eigen::Matrix3d jacobian = corners * slope;
      points.push_back({(slope * jacobian.inverse()).transpose(), jacobian.determinant() / 6});
    }
  return points;
}

Displacements some_displacements(double size) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-size, size);
  return Displacements::NullaryExpr([&] { return uniform(random); });
}

Eigen::Matrix3d a_rotation() {
  return Eigen::AngleAxisd(0.9, Eigen::Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
}

struct TissueCase {
  const char* name;
  FiniteTissue law;
  bool mean;
};

const Isotropic moduli(0.02, 0.45);

std::vector<TissueCase> tissues() {
  return {{"neo-Hookean", NeoHookeanTissue{moduli}, false},
          {"neo-Hookean, mean dilatation", NeoHookeanTissue{moduli}, true},
          {"St. Venant-Kirchhoff", StVenantKirchhoffTissue{moduli}, false}};
}

CellResponse respond(const TissueCase& tissue, const Displacements& u,
                     const Eigen::Matrix3d& initial = Eigen::Matrix3d::Zero()) {
  static const std::vector<ReferencePoint> points = points_of_a_wedge();
  CellResponse response;
  tissue.law.response(points, u, initial, tissue.mean, true, response);
  return response;
}

/// Differences of fourth order of a function of the displacements.
template <class Function>
auto differences(const Displacements& u, int unknown, const Function& f) {
  constexpr double step = 1e-3;
  const auto at = [&](double x) {
    Displacements moved = u;
    moved(unknown % 3, unknown / 3) += x * step;
    return f(moved);
  };
  using Value = std::decay_t<decltype(f(u))>;
  return Value((8 * (at(1) - at(-1)) - (at(2) - at(-2))) / (12 * step));
}

struct SkinCase {
  const char* name;
  FiniteSkin law;
};

const Eigen::Vector3d prestress(0.01, 0.03, 0.004);

std::vector<SkinCase> skins() {
  const SkinMaterial linear = isotropic_skin({});
  const double shear = Isotropic(0.13, 0.4).shear;
  return {{"St. Venant-Kirchhoff", {1.5, StVenantKirchhoffSkin{prestress, linear.elasticity}}},
          {"neo-Hookean", {1.5, NeoHookeanSkin{prestress, shear, 0.4}}},
          {"Fung", {1.5, FungSkin(prestress, linear.elasticity, 5, {})}},
          {"Fung without stiffening", {1.5, FungSkin(prestress, linear.elasticity, 1, {})}},
          {"Fung with fibres", {1.5, FungSkin(prestress, linear.elasticity, 10, {0.6, 0.5, 0.1})}}};
}

std::vector<Eigen::Vector3d> some_strains() {
  return {{0, 0, 0}, {0.05, -0.04, 0.03}, {-0.15, 0.2, -0.1}, {0.1, 0.15, 0.2}, {-0.2, -0.25, 0.05}};
}

}  // namespace

/// The sixth digit of differences of fourth order with steps of 1e-3 of the wedge.
TEST(FiniteTissue, ForcesAndTangentsAreDerivativesOfTheEnergy) {
  Eigen::Matrix3d initial;
  initial << 0.002, 0.001, 0, 0.001, 0.004, 0, 0, 0, 0;
  for (const TissueCase& tissue : tissues())
    for (const Eigen::Matrix3d& stress : {Eigen::Matrix3d(Eigen::Matrix3d::Zero()), initial}) {
      SCOPED_TRACE(tissue.name);
      const Displacements u = some_displacements(0.12);
      const CellResponse response = respond(tissue, u, stress);
      ASSERT_GT(response.least_determinant, 0.2);
      for (int i = 0; i < 18; ++i) {
        const double force =
            differences(u, i, [&](const Displacements& v) { return respond(tissue, v, stress).energy; });
        EXPECT_NEAR(response.force[i], force, 1e-6 * response.force.norm()) << i;
        const Vector18 column =
            differences(u, i, [&](const Displacements& v) { return respond(tissue, v, stress).force; });
        EXPECT_LT((response.stiffness.col(i) - column).norm(), 1e-6 * response.stiffness.norm()) << i;
      }
      EXPECT_LT((response.stiffness - response.stiffness.transpose()).norm(),
                1e-14 * response.stiffness.norm());
    }
}

TEST(FiniteTissue, TangentAtTheReferenceIsThatOfTheLinearLaw) {
  const std::vector<ReferencePoint> points = points_of_a_wedge();
  std::vector<CellPoint> linear(points.size());
  double volume = 0;
  Eigen::Matrix<double, 3, 6> mean = Eigen::Matrix<double, 3, 6>::Zero();
  for (const ReferencePoint& p : points) volume += p.volume, mean += p.volume * p.gradients;
  for (const TissueCase& tissue : tissues()) {
    SCOPED_TRACE(tissue.name);
    for (std::size_t q = 0; q < points.size(); ++q) {
      linear[q].volume = points[q].volume;
      linear[q].nodes.resize(6);
      for (int a = 0; a < 6; ++a)
        for (int i = 0; i < 3; ++i) {
          linear[q].nodes[a].strain[i] = points[q].gradients(i, a);
          linear[q].nodes[a].dilatation[i] = tissue.mean ? mean(i, a) / volume : points[q].gradients(i, a);
        }
    }
    dealii::FullMatrix<double> expected(18, 18);
    TissueMaterial(LinearIsotropic{moduli}).add_stiffness(linear, expected);
    const CellResponse response = respond(tissue, Displacements::Zero());
    EXPECT_LT(response.force.norm(), 1e-17);
    for (int i = 0; i < 18; ++i)
      for (int j = 0; j < 18; ++j)
        EXPECT_NEAR(response.stiffness(i, j), expected(i, j), 1e-15) << i << ", " << j;
  }
}

TEST(FiniteTissue, RotationsChangeNoEnergyAndTurnTheForces) {
  const std::vector<ReferencePoint> points = points_of_a_wedge();
  const Eigen::Matrix3d rotation = a_rotation();
  // x = R (X + u): with G^T the gradient of X, displacements whose gradient is R (I + grad u) - I.
  Eigen::Matrix<double, 3, 6> corners;
  corners << 0, 1.1, 0.1, -0.05, 1, 0.2,  //
      0, 0.1, 0.9, 0.1, -0.1, 1,          //
      0, 0.05, -0.1, 0.8, 1, 0.9;
  for (const TissueCase& tissue : tissues()) {
    SCOPED_TRACE(tissue.name);
    const Displacements u = some_displacements(0.12);
    const CellResponse straight = respond(tissue, u);
    const CellResponse turned = respond(tissue, rotation * (corners + u) - corners);
    EXPECT_NEAR(turned.energy, straight.energy, 1e-13 * straight.energy);
    for (int a = 0; a < 6; ++a)
      EXPECT_LT((turned.force.segment<3>(3 * a) - rotation * straight.force.segment<3>(3 * a)).norm(),
                1e-13 * straight.force.norm());
  }
}

/// F = J^(1/3) I: the pressure is kappa (J - 1), and the work done on it the energy; uniform stretches s of
/// St. Venant-Kirchhoff: S = 3 kappa (s^2 - 1) / 2.
TEST(FiniteTissue, UniformExpansionHasTheEnergyOfItsClosedForm) {
  const std::vector<ReferencePoint> points = points_of_a_wedge();
  Eigen::Matrix<double, 3, 6> corners;
  corners << 0, 1.1, 0.1, -0.05, 1, 0.2,  //
      0, 0.1, 0.9, 0.1, -0.1, 1,          //
      0, 0.05, -0.1, 0.8, 1, 0.9;
  double volume = 0;
  for (const ReferencePoint& p : points) volume += p.volume;
  const double s = 1.2, j = s * s * s, e = (s * s - 1) / 2;
  for (const TissueCase& tissue : tissues()) {
    SCOPED_TRACE(tissue.name);
    const double expected =
        tissue.law.has_volume() ? moduli.bulk / 2 * (j - 1) * (j - 1) : 9 * moduli.bulk / 2 * e * e;
    EXPECT_NEAR(respond(tissue, (s - 1) * corners).energy, volume * expected, 1e-14);
  }
}

TEST(FiniteTissue, ACellThatTurnsInsideOutIsNoticed) {
  Displacements u = Displacements::Zero();
  u(2, 3) = u(2, 4) = u(2, 5) = -1.2;
  for (const TissueCase& tissue : tissues())
    EXPECT_LT(respond(tissue, u).least_determinant, 0) << tissue.name;
}

TEST(FiniteSkin, StressAndTangentAreDerivativesOfTheEnergy) {
  for (const SkinCase& skin : skins())
    for (const Eigen::Vector3d& strain : some_strains()) {
      SCOPED_TRACE(skin.name);
      const SkinResponse response = skin.law.at(strain);
      for (int i = 0; i < 3; ++i) {
        constexpr double step = 1e-4;
        const Eigen::Vector3d d = step * Eigen::Vector3d::Unit(i);
        const auto slope = [&](auto&& f) {
          using Value = decltype(f(strain));
          return Value((8 * (f(strain + d) - f(strain - d)) - (f(strain + 2 * d) - f(strain - 2 * d))) /
                       (12 * step));
        };
        EXPECT_NEAR(response.stress[i],
                    slope([&](const Eigen::Vector3d& e) { return skin.law.at(e).energy; }), 1e-9);
        const Eigen::Vector3d column =
            slope([&](const Eigen::Vector3d& e) -> Eigen::Vector3d { return skin.law.at(e).stress; });
        EXPECT_LT((response.tangent.col(i) - column).norm(), 1e-8 * response.tangent.norm());
      }
    }
}

TEST(FiniteSkin, TheReferenceStateHasThePrestressAndTheLinearModuli) {
  const Eigen::Matrix3d elasticity = isotropic_skin({}).elasticity;
  for (const SkinCase& skin : skins()) {
    SCOPED_TRACE(skin.name);
    const SkinResponse response = skin.law.at(Eigen::Vector3d::Zero());
    EXPECT_LT((response.stress - prestress).norm(), 1e-16);
    EXPECT_LT((response.tangent - elasticity).norm(), 1e-15);
  }
}

/// A sheet of nu = 1/2 stretched by a in all directions: S = mu (1 - a^-6); along one: with the width
/// 1/sqrt(a) the stress across is 0 and along mu (1 - a^-3).
TEST(FiniteSkin, NeoHookeanSheetsHaveTheStressOfTheirClosedForms) {
  constexpr double mu = 0.05, a = 1.3;
  const NeoHookeanSkin skin{Eigen::Vector3d::Zero(), mu, 0.5};
  const double e = (a * a - 1) / 2;
  const Eigen::Vector3d biaxial = skin.at({e, e, 0}).stress;
  EXPECT_NEAR(biaxial[0], mu * (1 - std::pow(a, -6)), 1e-16);
  EXPECT_NEAR(biaxial[1], biaxial[0], 1e-16);
  const Eigen::Vector3d uniaxial = skin.at({e, (1 / a - 1) / 2, 0}).stress;
  EXPECT_NEAR(uniaxial[0], mu * (1 - std::pow(a, -3)), 1e-16);
  EXPECT_NEAR(uniaxial[1], 0, 1e-16);
  // Compressible: the stress across the sheet vanishes, mu (c - 1) + lambda ln J = 0.
  const NeoHookeanSkin soft{Eigen::Vector3d::Zero(), mu, 0.3};
  const double c = soft.thickness_stretch_squared(a * a * a * a);
  EXPECT_NEAR(mu * (c - 1) + Isotropic(2 * 1.3 * mu, 0.3).lame * std::log(a * a * std::sqrt(c)), 0, 1e-16);
}

/// Along the prestress the tangent falls to that of the linear law over the stiffening where no stress is
/// left.
TEST(FiniteSkin, FungSkinSoftensToItsToe) {
  const double E = 0.13, s = 0.03, stiffening = 5;
  const ExponentialLaw<1> law{Eigen::Matrix<double, 1, 1>(s), Eigen::Matrix<double, 1, 1>(E), stiffening};
  double least = 0, greatest = 1;  // the strain without stress, by bisection
  for (int i = 0; i < 60; ++i) {
    const double middle = (least + greatest) / 2;
    (law.at(Eigen::Matrix<double, 1, 1>(-middle)).stress[0] > 0 ? least : greatest) = middle;
  }
  EXPECT_NEAR(law.at(Eigen::Matrix<double, 1, 1>(-least)).tangent(0, 0), E / stiffening, 1e-9);
  EXPECT_GT(law.at(Eigen::Matrix<double, 1, 1>(0.1)).tangent(0, 0), 1.5 * E);
}

TEST(FiniteSkin, FibresStiffenTheirOwnDirectionAndOnlyUnderTension) {
  const Eigen::Matrix3d elasticity = isotropic_skin({}).elasticity;
  const Eigen::Vector3d alike(0.02, 0.02, 0);
  const auto tangent_along = [&](const FungSkin::Fibres& fibres, const Eigen::Vector3d& strain, int axis) {
    return FungSkin(alike, elasticity, 10, fibres).at(strain).tangent(axis, axis);
  };
  const Eigen::Vector3d u(0.1, 0, 0), v(0, 0.1, 0), released(-0.3, -0.3, 0);
  EXPECT_NEAR(tangent_along({}, u, 0), tangent_along({}, v, 1), 1e-14);
  EXPECT_GT(tangent_along({0.6, 0, 0}, u, 0), 1.1 * tangent_along({0.6, 0, 0}, v, 1));
  EXPECT_NEAR(tangent_along({0.6, 0, 0.5}, u, 0), tangent_along({0.6, 0, 0.5}, v, 1), 1e-14);
  const double quarter = std::acos(0.);
  EXPECT_NEAR(tangent_along({0.6, 0, 0.1}, u, 0), tangent_along({0.6, quarter, 0.1}, v, 1), 1e-14);
  // At 45 degrees: all turned by them, the strain 0.1 along the diagonal and the tangent along it too.
  const Eigen::Vector3d diagonal(0.5, 0.5, 1);
  const FungSkin turned(alike, elasticity, 10, {0.6, quarter / 2, 0.1});
  EXPECT_NEAR(diagonal.dot(turned.at(0.1 * diagonal).tangent * diagonal), tangent_along({0.6, 0, 0.1}, u, 0),
              1e-14);
  // Slack fibres leave the matrix alone: less stiff than where they were part of it.
  EXPECT_LT(tangent_along({0.6, 0, 0}, released, 0), 0.6 * tangent_along({0, 0, 0}, released, 0));
}

/// On the way to where fibres are slack the stress has no jump, and its work is the energy (Simpson's rule;
/// the tangent's one jump leaves the square of the step).
TEST(FiniteSkin, FibresBecomeSlackWithoutAJump) {
  const Eigen::Matrix3d elasticity = isotropic_skin({}).elasticity;
  const FungSkin skin(prestress, elasticity, 10, {0.6, 0.5, 0.1});
  const Eigen::Vector3d end(-0.3, -0.35, 0.05);
  constexpr int steps = 3000;
  double work = 0, largest_jump = 0;
  for (int i = 0; i < steps; ++i) {
    const auto stress = [&](double part) { return skin.at((i + part) / steps * end).stress; };
    work += (stress(0) + 4 * stress(0.5) + stress(1)).dot(end) / (6 * steps);
    largest_jump = std::max(largest_jump, (stress(1) - stress(0)).norm());
  }
  const double energy = skin.at(end).energy;
  EXPECT_NEAR(work - energy + skin.at(Eigen::Vector3d::Zero()).energy, 0, 1e-6 * std::abs(energy));
  EXPECT_LT(largest_jump, elasticity.norm() * end.norm() / steps);  // the skin softens on its way
}

}  // namespace cleft
