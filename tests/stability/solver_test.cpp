// Where the solver's linear algebra fails: against dense matrices, and K solved in long double.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <cmath>

#include "solver/companion.h"
#include "solver/direct_solver.h"
#include "solver/frame_figures.h"
#include "tests/solver/dense_patch.h"
#include "tests/support/even_piece.h"
#include "tests/support/refusal.h"
#include "tests/support/stability_row.h"

namespace cleft {

namespace {

/// A few hundred unknowns.
Parameters tiny_patch() {
  Parameters p = even_piece();
  p.patch.length = 5, p.patch.width = 4, p.patch.height = 2;
  p.cut.length = 3, p.cut.depth = 1;
  return p;
}

std::string failure_of_factor(const DensePatch& patch) {
  try {
    DirectSolver(patch.mesh, patch.system).factorize();
  } catch (const SolveError& e) {
    return e.what();
  }
  return "";
}

struct OpenPatch {
  double error = 0;     ///< of the displacement, relative: against K u = f in long double
  double residual = 0;  ///< as `cleft solve` tells it
  double rounding = 0;  ///< by which `cleft solve` decides
};

/// With its cut fully open.
OpenPatch solve_open(const Parameters& p) {
  const DensePatch patch(p);
  DirectSolver solver(patch.mesh, patch.system);
  solver.factorize();
  solver.set_release(patch.release);
  OpenPatch open;
  open.rounding = rounding_error(patch.system, solver);
  solver.set_loads(patch.own(patch.load));
  const std::vector<FrameSolver::Column> columns = {{0, patch.release.released.back()}};
  const Block found = solver.solve(columns);
  using Matrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
  const Eigen::VectorXd exact = Matrix(patch.stiffness.cast<long double>())
                                    .partialPivLu()
                                    .solve(patch.load.cast<long double>())
                                    .cast<double>();
  open.error = (patch.whole(found) - exact).norm() / exact.norm();
  const FrameResidual residual(patch.mesh, patch.system);
  const Block left_over = residual.left_over(patch.own(patch.load), found);
  open.residual = residual.figures(patch.release, columns, found, left_over, patch.load.cwiseAbs().maxCoeff())
                      .front()
                      .residual_equilibrium;
  return open;
}

const std::string refused_by_rounding =
    "`cleft solve`: a translation that K^-1 K must reproduce, once for each K; exit code 1 beyond 1e-6";

/// The estimate is no less than the error, nor beyond what makes it useless.
void expect_estimate(const OpenPatch& open, double generous) {
  EXPECT_LE(open.error, open.rounding);
  EXPECT_LE(open.rounding, generous * open.error);
}

}  // namespace

TEST(SolverLimits, StiffnessRatios) {
  std::string shown;
  const auto solve = [](double skin, double springs) {
    Parameters p = tiny_patch();
    p.skin.young_modulus = skin * p.tissue.young_modulus;
    p.foundation.stiffness = p.foundation.side_stiffness = p.tissue.young_modulus / springs;
    return solve_open(p);
  };
  const OpenPatch skin = solve(1e8, 4), springs = solve(6.5, 1e8), beyond = solve(1e14, 4);
  for (const OpenPatch& open : {skin, springs, beyond}) expect_estimate(open, 30);
  EXPECT_LT(skin.rounding, largest_rounding);
  EXPECT_LT(springs.rounding, largest_rounding);
  EXPECT_GT(beyond.rounding, largest_rounding);
  EXPECT_LT(beyond.residual, 1e-12) << "the residual would have told";
  record_limit({.method = "Cholesky factor of K",
                .limit = "moduli and springs of very different size",
                .shown = "error against K in long double: skin 1e8 times the tissue, below " +
                         power_of_ten(skin.error) + "; tissue 1e8 mm times the springs, " +
                         power_of_ten(springs.error) + "; skin 1e14 times the tissue, " +
                         power_of_ten(beyond.error) + ", where the forces still balance to 1e-12",
                .noticed = refused_by_rounding,
                .then = "refused, no file"});
}

TEST(SolverLimits, FlatWedges) {
  const auto flat = [](double aspect) {
    Parameters p = tiny_patch();
    p.patch.height /= aspect, p.cut.depth /= aspect;
    return solve_open(p);
  };
  const OpenPatch sound = flat(1e4), beyond = flat(1e10);
  EXPECT_LT(sound.error, largest_rounding);
  EXPECT_LE(beyond.error, beyond.rounding);
  EXPECT_GT(beyond.rounding, largest_rounding);
  double refused = 1e4;
  while (flat(refused).rounding < largest_rounding) refused *= 10;
  EXPECT_GT(refused, 1e6);
  EXPECT_LT(refused, 1e10);
  record_limit({.method = "wedges of the patch",
                .limit = "elements much flatter than wide",
                .shown = "wedges 1e4 times wider than high: error below " + power_of_ten(sound.error) +
                         ", estimated as " + power_of_ten(sound.rounding) + "; 1e10 times: error below " +
                         power_of_ten(beyond.error) + ", estimated as " + power_of_ten(beyond.rounding),
                .noticed = refused_by_rounding + " (here from " + power_of_ten(refused) + " times)",
                .then = "refused, no file"});
}

TEST(SolverLimits, NoFoundation) {
  Parameters p = tiny_patch();
  p.foundation.stiffness = p.foundation.side_stiffness = 0;
  const DensePatch patch(p);
  const Eigen::VectorXd values =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(patch.stiffness, Eigen::EigenvaluesOnly).eigenvalues();
  const auto motions = (values.array() < 1e-12 * values.maxCoeff()).count();
  EXPECT_EQ(motions, 6);  // the rigid ones
  EXPECT_NE(refusal_of(p), "");
  record_limit({.method = "K of the patch",
                .limit = "no foundation",
                .shown = std::to_string(motions) + " eigenvalues of K are 0 to rounding; the next one is " +
                         rounded(values[6]) + " N/mm",
                .noticed = quoted(refusal_of(p), "foundation.stiffness"),
                .then = "refused before the work, exit code 2"});
}

TEST(SolverLimits, CompressivePrestress) {
  Parameters p = tiny_patch();
  p.skin.initial_stress_stiffness = true;
  const auto smallest = [&](double compression) {
    p.skin.prestress.uu = p.skin.prestress.vv = -compression;
    return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(DensePatch(p).stiffness, Eigen::EigenvaluesOnly)
        .eigenvalues()
        .minCoeff();
  };
  const double held = smallest(0.001);
  EXPECT_GT(held, 0);
  EXPECT_EQ(failure_of_factor(DensePatch(p)), "");
  const double buckled = smallest(0.01);
  EXPECT_LT(buckled, 0);
  const std::string failure = failure_of_factor(DensePatch(p));
  const std::string before = "its smallest eigenvalue is at most ";
  ASSERT_NE(failure.find(before), std::string::npos) << failure;
  EXPECT_NEAR(std::stod(failure.substr(failure.find(before) + before.size())), buckled, 0.02 * -buckled);
  EXPECT_NE(refusal_of(p), "");
  record_limit({.method = "prestressed skin, `skin.initial_stress_stiffness`",
                .limit = "compression: K becomes indefinite",
                .shown = "smallest eigenvalue of K: " + rounded(held) + " N/mm at -0.001 MPa, " +
                         rounded(buckled) + " N/mm at -0.01 MPa",
                .noticed = "before the work: " + quoted(refusal_of(p), "skin.prestress_u") +
                           "; by the factor: " + quoted(failure, "its smallest eigenvalue"),
                .then = "refused, exit code 2"});
}

TEST(SolverLimits, RedundantConstraints) {
  const DensePatch patch(tiny_patch());
  const Eigen::MatrixXd once = patch.closure(patch.release, 0);
  Eigen::MatrixXd twice(2 * once.rows(), once.cols());
  twice << once, once;
  const auto rank = [](const Eigen::MatrixXd& m) { return m.colPivHouseholderQr().rank(); };
  const Eigen::MatrixXd s = twice * patch.stiffness.ldlt().solve(twice.transpose());
  // The same pairs once to stay closed and once to stand 1 mm apart.
  Eigen::MatrixXd with_gaps(s.rows(), s.cols() + 1);
  with_gaps << s, Eigen::VectorXd::Zero(s.rows());
  with_gaps.col(s.cols()).tail(once.rows()).setOnes();
  EXPECT_EQ(rank(s), once.rows());
  EXPECT_EQ(rank(with_gaps), once.rows() + 1);  // no multipliers give them

  DirectSolver solver(patch.mesh, patch.system);
  solver.factorize();
  solver.set_release(patch.release);
  solver.set_loads(patch.own(patch.load));
  const Eigen::MatrixXd closed = patch.whole(solver.solve({{0, 0}}));
  EXPECT_EQ((once * closed).cwiseAbs().maxCoeff(), 0);
  record_limit({.method = "multipliers for the closed pairs (the paper's S = C K^-1 C^T)",
                .limit = "redundant and contradictory constraints",
                .shown = "every pair written twice: S of " + std::to_string(s.rows()) + " rows has rank " +
                         std::to_string(rank(s)) + ", with contradicting gaps next to it rank " +
                         std::to_string(rank(with_gaps)),
                .noticed = "cannot occur: the unknowns of a pair are its left node and its jump",
                .then = "a closed pair has no jump: gaps are 0 to the last bit"});
}

TEST(SolverLimits, ACutThatSeversThePatch) {
  Parameters p = tiny_patch();
  const auto gape_where_left = [&](double left) {
    p.cut.depth = p.patch.height - left;
    EXPECT_EQ(refusal_of(p), "");
    return gape_of(p, MPI_COMM_WORLD);
  };
  const double tenth = gape_where_left(0.1), little = gape_where_left(0.01), least = gape_where_left(0.001);
  EXPECT_NEAR(little / tenth, 1, 0.02);
  EXPECT_NEAR(least / little, 1, 0.02);  // it comes to an end
  p.cut.depth = p.patch.height;
  const std::string too_deep = refusal_of(p);
  p = tiny_patch();
  p.cut.length = p.patch.length;
  record_limit({.method = "patch with a cut in its middle",
                .limit = "a cut that severs it",
                .shown = "gape with 0.1, 0.01 and 0.001 mm of 2 mm left below the cut: " + rounded(tenth) +
                         ", " + rounded(little) + ", " + rounded(least) + " mm: the springs hold the halves",
                .noticed = quoted(too_deep, "cut.depth") + ", " + quoted(refusal_of(p), "cut.length"),
                .then = "refused before the work, exit code 2; a surface mesh may be cut in two"});
}

TEST(SolverLimits, CutsOneElementWide) {
  Parameters p = even_piece();
  p.patch.length = 6, p.patch.width = 4, p.patch.height = 2;
  p.cut.length = 2, p.cut.depth = 1;
  const auto gape_at = [&](double element_size) {
    p.mesh.element_size = element_size;
    return gape_of(p, MPI_COMM_WORLD);
  };
  const double one = gape_at(1);
  const ErrorEstimate estimate = expected_error(p, one, MPI_COMM_WORLD);
  ASSERT_TRUE(estimate.expected) << estimate.obstacle;
  const double two = gape_at(0.5);
  p.mesh.grading = 1.5;
  const double fine = gape_at(0.125);
  EXPECT_LT(one, two);
  EXPECT_LT(two, fine);
  p.mesh.element_size = 1.1;
  record_limit({.method = "mesh of the cut",
                .limit = "a cut of one column of nodes",
                .shown = "gape of a cut of 2 mm with elements of 1 and 0.5 mm: " + rounded(one / fine) +
                         " and " + rounded(two / fine) + " of that with elements of 0.125 mm",
                .noticed = "`cleft solve` compares with elements half as long, and expects the first to be "
                           "off by " +
                           rounded(estimate.expected->mesh) + " of its gape; fewer than one column: " +
                           quoted(refusal_of(p), "mesh.element_size"),
                .then = "solved with a warning; fewer than one column is refused, exit code 2"});
}

}  // namespace cleft
