// Newton's method near equilibria that are none to end at: saddles of the energy, and elements that have
// turned inside out.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <string>

#include "tests/solver/newton_frames.h"

namespace cleft {

namespace {

/// A closed piece under finite strains, with dense matrices of the displacements that keep its pairs
/// together.
class ClosedPiece {
 public:
  explicit ClosedPiece(const Parameters& p) : parameters(p), patch(p), finite(patch.system, p) {
    patch.release.released.resize(1);
    finite.set_open(patch.release, 0);
    const Eigen::MatrixXd ties = patch.closure(patch.release, 0).transpose();
    const Eigen::MatrixXd q = ties.householderQr().householderQ();
    moving = q.rightCols(q.cols() - ties.cols());
  }

  Eigen::MatrixXd tangent(const Block& u) {
    finite.set_tangent(u);
    const Eigen::MatrixXd all = Eigen::MatrixXd::Identity(patch.system.size(), patch.system.size());
    return moving.transpose() * patch.whole(finite.multiply(patch.own(all))) * moving;
  }

  Eigen::VectorXd unbalanced(const Block& u) const {
    return moving.transpose() * patch.whole(finite.balance(u).left_over);
  }

  bool is_stable(const Block& u) { return Eigen::LLT<Eigen::MatrixXd>(tangent(u)).info() == Eigen::Success; }

  double largest_load() const { return patch.load.cwiseAbs().maxCoeff(); }

  Parameters parameters;
  DensePatch patch;
  FinitePatch finite;
  Eigen::MatrixXd moving;  // orthonormal columns
};

/// Skin that is pushed together as it lies, which parameters do not permit: balanced, but not stably.
Parameters compressed(double stress) {
  Parameters p = finite_case();
  p.skin.edges = SkinEdges::held, p.skin.prestress = {stress, stress, 0};
  p.skin.initial_stress_stiffness = false;  // of the system, whose factor is a preconditioner
  return p;
}

}  // namespace

/// From a start so near to a saddle that a step of Newton's method, which meets its negative curvature, ends
/// in balance: either the skin buckles to a stable state, or it is refused.
TEST(Newton, ASaddleIsNoSolution) {
  int starts = 0;
  for (const double stress : {-0.0025, -0.003, -0.004}) {
    ClosedPiece piece(compressed(stress));
    const Block flat = Block::Zero(piece.patch.system.owned(), 1);
    EXPECT_LT(piece.unbalanced(flat).cwiseAbs().maxCoeff(), 1e-13 * piece.largest_load());
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes(piece.tangent(flat));
    if (modes.eigenvalues()[0] > -1e-4) continue;
    Eigen::VectorXd force(piece.moving.cols());
    for (Eigen::Index i = 0; i < force.size(); ++i)
      force[i] = std::sin(7. * static_cast<double>(i * i)) * (modes.eigenvalues()[i] < 0 ? 0.02 : 1);
    const Eigen::VectorXd away = modes.eigenvectors() * force.cwiseQuotient(modes.eigenvalues());
    const double unit = piece.largest_load() /
                        piece.unbalanced(1e-6 * piece.patch.own(piece.moving * away)).cwiseAbs().maxCoeff() *
                        1e-6;
    for (const double residual : {1.2e-7, 2e-7, 4e-7, 1e-6}) {
      SCOPED_TRACE("stress " + std::to_string(stress) + ", residual " + std::to_string(1e7 * residual) +
                   "e-7");
      ++starts;
      try {
        const Block u = newton_from(piece.patch, piece.parameters,
                                    piece.patch.own(piece.moving * away) * (residual * unit));
        EXPECT_TRUE(piece.is_stable(u)) << "a saddle";
      } catch (const SolveError& e) {
        EXPECT_NE(std::string(e.what()).find("the tangent is indefinite"), std::string::npos) << e.what();
      }
    }
  }
  EXPECT_GE(starts, 8);
}

/// A corner of the piece is drawn far out. The law's stiffness is less there than where it comes back to, so
/// that whole steps of Newton's method turn its element inside out, where it has no forces.
TEST(Newton, NoStepTurnsAnElementInsideOut) {
  ClosedPiece piece(finite_case());
  const Eigen::MatrixX4d places = piece.patch.system.places();
  const Block none = Block::Zero(piece.patch.system.owned(), 1);
  const Block expected = newton_from(piece.patch, piece.parameters, none);
  int shortened = 0;
  for (double pull = 1; pull <= 4; pull += 0.25) {
    SCOPED_TRACE("pulled by " + std::to_string(pull) + " mm");
    Block u = none;
    for (Eigen::Index i = 0; i < u.rows(); ++i)
      if (places(i, 0) == 4 && places(i, 1) == 2 && places(i, 2) == -3 && places(i, 3) == 2) u(i) = -pull;
    NewtonFrame report;
    u = newton_from(piece.patch, piece.parameters, u, &report);
    EXPECT_GT(piece.finite.balance(u).least.determinant, 0.5);
    EXPECT_LT(piece.patch.whole(u - expected).cwiseAbs().maxCoeff(), 1e-5);
    EXPECT_EQ(report.load_steps, 1);
    for (const NewtonStep& step : report.steps) shortened += step.length < 1;
  }
  EXPECT_GT(shortened, 3);
}

/// Free pieces of soft skin under a high tension: on their way to the state in which they are in balance they
/// buckle, or elements would turn inside out. Where a whole step of the load ends at a saddle or nowhere,
/// parts of it lead on; what is found is in balance, and stable: the tangent is positive definite among the
/// displacements that keep closed pairs together. (Which cases need parts hangs on rounding; these are a few
/// of many.)
TEST(Newton, BucklingPiecesComeToAStableBalanceInPartsOfTheLoad) {
  struct Piece {
    double tissue, bending;
    Prestress prestress;
  };
  std::vector<Piece> pieces{{0.02, 0.2, {0.2, 0.3, 0.12}}};
  for (const double tissue : {0.02, 0.022, 0.024, 0.027, 0.03, 0.033})
    for (const Prestress& prestress : {Prestress{0.1, 0.15, 0.06}, {0.1, 0.17, 0.03}})
      pieces.push_back({tissue, 0, prestress});
  int in_parts = 0, indefinite = 0, shortened = 0;
  for (const Piece& piece : pieces) {
    SCOPED_TRACE("tissue " + std::to_string(piece.tissue) + ", tension " +
                 std::to_string(piece.prestress.vv));
    Parameters p = finite_case();
    p.skin.law = SkinLaw::neo_hookean, p.skin.prestress = piece.prestress;
    p.tissue.young_modulus = piece.tissue, p.skin.bending_stiffness = piece.bending;
    ClosedPiece closed(p);
    std::vector<NewtonFrame> reports;
    const Block u = newton_frames(closed.patch, p, &reports).front();
    in_parts += reports.front().load_steps > 1;
    for (const NewtonStep& step : reports.front().steps)
      indefinite += step.indefinite, shortened += step.length < 1;
    EXPECT_GT(closed.finite.balance(u).least.determinant, 0);
    EXPECT_LT(closed.unbalanced(u).cwiseAbs().maxCoeff(), 1e-6 * closed.largest_load());
    EXPECT_TRUE(closed.is_stable(u)) << "a saddle";
  }
  EXPECT_GT(in_parts, 0);
  EXPECT_GT(indefinite, 0);
  EXPECT_GT(shortened, 0);
}

}  // namespace cleft
