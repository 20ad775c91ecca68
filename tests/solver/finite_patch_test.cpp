// The patch under finite strains: its forces and tangent against differences, its reference state, and its
// series against the small model's where the tension is small.
#include "solver/finite_patch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "solver/bending.h"
#include "tests/solver/newton_frames.h"

namespace cleft {

namespace {

struct FiniteCase {
  const char* name;
  Parameters parameters;
};

std::vector<FiniteCase> finite_cases() {
  std::vector<FiniteCase> cases;
  for (const SkinLaw law : {SkinLaw::st_venant_kirchhoff, SkinLaw::neo_hookean, SkinLaw::fung}) {
    cases.push_back({"neo-Hookean tissue", finite_case()});
    cases.back().parameters.skin.law = law;
  }
  cases.push_back({"St. Venant-Kirchhoff tissue", finite_case()});
  cases.back().parameters.tissue.law = TissueLaw::st_venant_kirchhoff;
  cases.push_back({"mean dilatation", finite_case()});
  cases.back().parameters.tissue.formulation = TissueFormulation::mean_dilatation;
  cases.back().parameters.tissue.poisson_ratio = 0.49;
  cases.push_back({"tissue under stress", finite_case()});
  cases.back().parameters.tissue.prestress_share = 0.4;
  cases.push_back({"skin that resists bending", finite_case()});
  cases.back().parameters.skin.bending_stiffness = 0.02;
  return cases;
}

/// A smooth displacement of this rank's unknowns, equal on any number of ranks.
Block some_displacement(const PatchSystem& system, double size) {
  const Eigen::MatrixX4d places = system.places();
  Block u(system.owned(), 1);
  for (Eigen::Index i = 0; i < u.rows(); ++i) {
    const auto at = places.row(i);
    u(i) = size * std::sin(1.3 * at[0] + 0.7 * at[1] - 0.5 * at[2] + 2 * at[3]);
  }
  return u;
}

double norm_of(const PatchSystem& system, const Block& block) {
  return std::sqrt(dot(system, block.col(0), block.col(0)));
}

}  // namespace

TEST(FinitePatch, TheReferenceStateHasTheLoadAndTheTangentOfTheSystem) {
  for (const FiniteCase& c : finite_cases()) {
    SCOPED_TRACE(c.name);
    const DensePatch patch(c.parameters);
    FinitePatch finite(patch.system, c.parameters);
    const Block none = Block::Zero(patch.system.owned(), 1), some = some_displacement(patch.system, 1);
    const Block load = patch.own(patch.load);
    EXPECT_LT(norm_of(patch.system, finite.balance(none).left_over - load), 1e-15 * patch.load.norm());
    EXPECT_NEAR(finite.balance(none).energy, 0, 1e-14);
    // Of tissue under stress the finite tangent has a geometric stiffness, which the system lacks.
    if (c.parameters.tissue.prestress_share > 0) continue;
    finite.set_tangent(none);
    const Block expected = patch.system.multiply(some);
    EXPECT_LT(norm_of(patch.system, finite.multiply(some) - expected),
              1e-13 * norm_of(patch.system, expected));
  }
}

/// The eighth digit: differences of fourth order.
TEST(FinitePatch, ForcesAndTangentAreDerivativesOfTheEnergy) {
  for (const FiniteCase& c : finite_cases()) {
    SCOPED_TRACE(c.name);
    const DensePatch patch(c.parameters);
    FinitePatch finite(patch.system, c.parameters);
    finite.set_open(patch.release, patch.release.released[2]);  // the rest of the cut resists bending
    const Block u = some_displacement(patch.system, 0.05);
    Block direction = some_displacement(patch.system, 1);
    direction = direction.array().square().matrix();
    constexpr double h = 1e-3;
    const auto at = [&](double x) { return finite.balance(u + x * h * direction); };
    const FinitePatch::Balance a = at(-2), b = at(-1), d = at(1), e = at(2);
    const double work = dot(patch.system, at(0).left_over.col(0), direction.col(0));
    EXPECT_NEAR(-work, (8 * (d.energy - b.energy) - (e.energy - a.energy)) / (12 * h), 1e-7 * std::abs(work));
    finite.set_tangent(u);
    const Block product = finite.multiply(direction);
    const Block slope = -(8 * (d.left_over - b.left_over) - (e.left_over - a.left_over)) / (12 * h);
    EXPECT_LT(norm_of(patch.system, product - slope), 1e-8 * norm_of(patch.system, product));
  }
}

TEST(FinitePatch, TheElementThatHasShrunkMostIsFound) {
  const Parameters p = finite_case();
  const DensePatch patch(p);
  const FinitePatch finite(patch.system, p);
  const Eigen::MatrixX4d places = patch.system.places();
  Block u = Block::Zero(patch.system.owned(), 1);
  for (Eigen::Index i = 0; i < u.rows(); ++i)  // a corner of the patch is pushed down
    if (places(i, 0) == 4 && places(i, 1) == 2 && places(i, 2) == 0 && places(i, 3) == 2) u(i) = -0.8;
  const FinitePatch::LeastElement least = finite.balance(u).least;
  EXPECT_LT(least.determinant, 0.5);
  EXPECT_NEAR(least.place.x, 3.5, 0.4);
  EXPECT_NEAR(least.place.y, 1.5, 0.4);
  EXPECT_NEAR(least.place.z, -0.5, 0.1);
}

/// The stiffness of the small model, whose skin bends freely along the whole cut, with the joints that are
/// closed (bending_test.cpp).
Eigen::MatrixXd with_joints(const DensePatch& patch, const Parameters& p, int open) {
  const std::set<int> closed(patch.release.order.begin() + open, patch.release.order.end());
  Eigen::MatrixXd k = patch.stiffness;
  for (const auto& [hinge, pairs] : skin_joints(patch.mesh)) {
    if (!std::includes(closed.begin(), closed.end(), pairs.begin(), pairs.end())) continue;
    for (int axis = 0; axis < 3; ++axis) {
      Eigen::VectorXd bend = Eigen::VectorXd::Zero(k.rows());
      for (int n = 0; n < 4; ++n) bend[patch.system.unknown(hinge.nodes[n], axis)] = hinge.bend[n];
      k += p.skin.bending_stiffness * hinge.weight * bend * bend.transpose();
    }
  }
  return k;
}

/// The difference is of the order of the strain: of a thousandth, more where the tissue is nearly
/// incompressible.
TEST(Newton, UnderSmallTensionTheSeriesIsThatOfTheSmallModel) {
  for (FiniteCase c : finite_cases()) {
    SCOPED_TRACE(c.name);
    Parameters& p = c.parameters;
    p.skin.prestress = {2e-5, 3e-5, 1.2e-5};
    p.skin.stiffening = 1;  // strains are large beside those of the toe of such a tension
    const DensePatch patch(p);
    const std::vector<Block> frames = newton_frames(patch, p);
    for (std::size_t j = 0; j < frames.size(); ++j) {
      const int open = patch.release.released[j];
      const Eigen::VectorXd expected =
          solve_with_multipliers(with_joints(patch, p, open), patch.closure(patch.release, open), patch.load);
      const Eigen::VectorXd found = patch.whole(frames[j]);
      EXPECT_LT((found - expected).norm(), 5e-3 * expected.norm() + 1e-15) << "frame " << j;
    }
  }
}

/// Each residual of the last steps is at most a constant times the square of the one before; and the forces
/// of a frame balance but for what closed pairs transmit.
TEST(Newton, ConvergesQuadraticallyToForcesInBalance) {
  for (const FiniteCase& c : finite_cases()) {
    SCOPED_TRACE(c.name);
    const DensePatch patch(c.parameters);
    std::vector<NewtonFrame> reports;
    const std::vector<Block> frames = newton_frames(patch, c.parameters, &reports);
    FinitePatch finite(patch.system, c.parameters);
    for (std::size_t j = 0; j < frames.size(); ++j) {
      finite.set_open(patch.release, patch.release.released[j]);
      const NewtonFrame& report = reports[j];
      SCOPED_TRACE("frame " + std::to_string(j));
      EXPECT_LT(report.residual, 1e-7);
      EXPECT_EQ(report.load_steps, 1);
      for (std::size_t i = 2; i < report.steps.size(); ++i) {
        const double before = report.steps[i - 1].residual, after = report.steps[i].residual;
        if (before < 0.01 && before > 1e-4) {
          EXPECT_LT(after, 200 * before * before) << "step " << i;
        }
      }
      Eigen::MatrixXd closure = patch.closure(patch.release, patch.release.released[j]).transpose();
      const Eigen::VectorXd left_over = patch.whole(finite.balance(frames[j]).left_over);
      Eigen::VectorXd unbalanced = left_over;
      if (closure.cols() > 0) unbalanced -= closure * closure.colPivHouseholderQr().solve(left_over);
      EXPECT_LT(unbalanced.cwiseAbs().maxCoeff(), 1e-7 * patch.load.cwiseAbs().maxCoeff());
    }
  }
}

}  // namespace cleft
