// Lips that press on each other, against brute force over all sets of pairs that may touch.
#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "solver/direct_solver.h"
#include "solver/opening.h"
#include "tests/solver/dense_patch.h"

namespace cleft {

namespace {

/// x >= 0 with gap + G x >= 0 and no x where there is a gap: of all sets of touching pairs the one that fits,
/// of which a positive definite G has exactly one.
Eigen::VectorXd pressures_by_brute_force(const Eigen::VectorXd& gap, const Eigen::MatrixXd& g) {
  const int n = static_cast<int>(gap.size());
  Eigen::VectorXd best = Eigen::VectorXd::Zero(n);
  double least_violation = std::numeric_limits<double>::infinity();
  for (int set = 0; set < 1 << n; ++set) {
    std::vector<int> touching;
    for (int p = 0; p < n; ++p)
      if (set >> p & 1) touching.push_back(p);
    Eigen::VectorXd x = Eigen::VectorXd::Zero(n);
    if (!touching.empty())
      x(touching) = -Eigen::MatrixXd(g(touching, touching)).llt().solve(Eigen::VectorXd(gap(touching)));
    // Both in mm, so that they compare.
    const double violation = std::max(-(gap + g * x).minCoeff(), -g.diagonal().cwiseProduct(x).minCoeff());
    if (violation < least_violation) least_violation = violation, best = x;
  }
  EXPECT_LT(least_violation, 1e-9 * gap.cwiseAbs().maxCoeff()) << "no set fits";
  return best;
}

/// Displacement of K u + C^T v = f + N^T x, C u = 0 with gaps N u >= 0 and pressures x >= 0, one of them 0.
Eigen::VectorXd with_contact(const Eigen::MatrixXd& k, const Eigen::MatrixXd& closure,
                             const Eigen::MatrixXd& gaps, const Eigen::VectorXd& load) {
  Eigen::MatrixXd loads(load.size(), 1 + gaps.rows());
  loads << load, gaps.transpose();
  const Eigen::MatrixXd u = solve_with_multipliers(k, closure, loads);
  if (gaps.rows() == 0) return u;
  return u.col(0) + u.rightCols(gaps.rows()) *
                        pressures_by_brute_force(gaps * u.col(0), gaps * u.rightCols(gaps.rows()));
}

Eigen::MatrixXd solve_frames(const DensePatch& patch, const Eigen::VectorXd& load, bool contact) {
  DirectSolver solver(patch.mesh, patch.system);
  solver.factorize();
  solver.set_release(patch.release);
  solver.set_loads(patch.own(load));
  std::vector<FrameSolver::Column> columns;
  for (const int open : patch.release.released) columns.push_back({0, open, contact});
  return patch.whole(solver.solve(columns));
}

/// What keeps a frame in balance, f - K u = C^T v - N^T x: the pressures x, by pair, N.
Eigen::VectorXd pressures(const DensePatch& patch, const Eigen::VectorXd& load, const Eigen::VectorXd& u,
                          int open) {
  const Eigen::MatrixXd closure = patch.closure(patch.release, open), gaps = patch.gaps(patch.release, open);
  Eigen::MatrixXd forces(load.size(), closure.rows() + gaps.rows());
  forces << closure.transpose(), -gaps.transpose();
  const Eigen::VectorXd left_over = load - patch.stiffness * u;
  const Eigen::VectorXd found = forces.colPivHouseholderQr().solve(left_over);
  EXPECT_LT((left_over - forces * found).norm(), 1e-11 * load.norm()) << "lips must not hold by friction";
  return found.tail(open);
}

/// `u` of a frame with contact, `without` of the same without.
void expect_the_touching_set(const DensePatch& patch, int open, const Eigen::VectorXd& u,
                             const Eigen::VectorXd& without) {
  const Eigen::MatrixXd gaps = patch.gaps(patch.release, open);
  const Eigen::VectorXd expected =
      with_contact(patch.stiffness, patch.closure(patch.release, open), gaps, patch.load);
  EXPECT_LT((u - expected).norm(), 1e-10 * expected.norm());
  if (open == 0 || (gaps * without).minCoeff() > 0) {
    EXPECT_LT((u - without).norm(), 1e-13 * without.norm()) << "nothing touches";
    return;
  }
  EXPECT_GT((u - without).norm(), 1e-4 * without.norm());
  const Eigen::VectorXd gap = gaps * u, x = pressures(patch, patch.load, u, open);
  EXPECT_GT(gap.minCoeff(), -1e-12);
  EXPECT_GT(x.minCoeff(), -1e-12);
  EXPECT_LT(gap.cwiseAbs().cwiseMin(x.cwiseAbs()).maxCoeff(), 1e-12) << "a pressure across a gap";
  EXPECT_GT(x.maxCoeff(), 1e-6);
}

/// Enough of everything that lips open, touch partly and touch everywhere.
std::vector<DenseCase> pressed_cases() {
  std::vector<DenseCase> cases;
  for (DenseCase c : dense_cases()) {
    c.parameters.cut.frames = FrameEvery::column;
    // At most twelve pairs: 4096 sets.
    if (std::string(c.name) != "ShearedByPairs") cases.push_back(c);
    if (std::string(c.name) == "BranchInAMeshOfALargerCut" || std::string(c.name) == "TiltedArc") {
      c.parameters.skin.prestress.uu = 0.2, c.parameters.skin.prestress.vv = 0.01;
      c.parameters.skin.prestress.uv = 0.02;
      c.name = std::string(c.name) == "TiltedArc" ? "TiltedArcPulledAlong" : "BranchPulledAlong";
      cases.push_back(c);
    }
  }
  return cases;
}

}  // namespace

/// Tolerances: five digits of sixteen lost to the condition of K.
TEST(Contact, FramesAreThoseOfTheOneSetOfTouchingPairsThatFits) {
  for (const DenseCase& c : pressed_cases()) {
    SCOPED_TRACE(c.name);
    const DensePatch patch(c.parameters);
    const Eigen::MatrixXd frames = solve_frames(patch, patch.load, true);
    const Eigen::MatrixXd free = solve_frames(patch, patch.load, false);
    for (std::size_t j = 0; j < patch.release.released.size(); ++j) {
      SCOPED_TRACE("frame " + std::to_string(j));
      expect_the_touching_set(patch, patch.release.released[j], frames.col(static_cast<Eigen::Index>(j)),
                              free.col(static_cast<Eigen::Index>(j)));
    }
  }
}

TEST(Contact, APushedCutStaysClosedAlongItsNormal) {
  Parameters p = dense_patch_case();
  p.cut.depth = 1, p.skin.prestress.uv = 0.02;
  const DensePatch patch(p);
  const Eigen::MatrixXd frames = solve_frames(patch, -patch.load, true);
  for (std::size_t j = 1; j < patch.release.released.size(); ++j) {
    const int open = patch.release.released[j];
    const Eigen::VectorXd u = frames.col(static_cast<Eigen::Index>(j));
    const Eigen::MatrixXd closure = patch.closure(patch.release, open),
                          gaps = patch.gaps(patch.release, open);
    Eigen::MatrixXd both(closure.rows() + gaps.rows(), closure.cols());
    both << closure, gaps;
    const Eigen::VectorXd expected = patch.solve(both, -patch.load);
    EXPECT_LT((u - expected).norm(), 1e-10 * expected.norm()) << "frame " << j;
    EXPECT_GT(pressures(patch, -patch.load, u, open).minCoeff(), 1e-6) << "frame " << j;
  }
  EXPECT_GT((frames.rightCols(1) - frames.leftCols(1)).norm(), 1e-3 * frames.leftCols(1).norm())
      << "the lips slide";
}

/// Random flexibilities of low rank and a little more: touching pairs that strongly push each other open are
/// where exchanging all wrong signs at once may go in circles.
TEST(Contact, PivotingFindsTheSetOfAnyPositiveDefiniteProblem) {
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  const auto matrix = [&](int rows, int columns) {
    return Eigen::MatrixXd(Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return normal(random); }));
  };
  constexpr int pairs = 7;
  for (int trial = 0; trial < 400; ++trial) {
    const bool chain = trial % 3 == 0;  // pairs (0, 1), (1, 2), ...: all copies of one node
    const int nodes = chain ? pairs + 1 : 2 * pairs, size = 3 * nodes;
    const Eigen::MatrixXd b = matrix(size, 1 + trial % 5);
    const Eigen::MatrixXd k = (b * b.transpose() + 1e-2 * Eigen::MatrixXd::Identity(size, size))
                                  .llt()
                                  .solve(Eigen::MatrixXd::Identity(size, size));
    const Eigen::VectorXd load = k * b * matrix(static_cast<int>(b.cols()), 1) + matrix(size, 1);
    std::vector<std::array<int, 2>> of_nodes;
    std::vector<Vec3> normals;
    std::vector<int> order(pairs);
    for (int p = 0; p < pairs; ++p) {
      of_nodes.push_back(chain ? std::array{p, p + 1} : std::array{2 * p, 2 * p + 1});
      const Eigen::Vector3d n = matrix(3, 1).normalized();
      normals.push_back({n(0), n(1), n(2)});
      order[p] = p;
    }
    std::shuffle(order.begin(), order.end(), random);
    Eigen::MatrixXd jumps = Eigen::MatrixXd::Zero(3 * pairs, size), gaps = Eigen::MatrixXd::Zero(pairs, size);
    for (int i = 0; i < pairs; ++i)
      for (int axis = 0; axis < 3; ++axis)
        for (const int side : {0, 1}) {
          const int unknown = 3 * of_nodes[order[i]][side] + axis, sign = side == 0 ? -1 : 1;
          jumps(3 * i + axis, unknown) = sign;
          gaps(i, unknown) = sign * normals[order[i]][axis];
        }
    Eigen::MatrixXd across = Eigen::MatrixXd::Zero(3 * pairs, size);  // jumps of the pairs as numbered
    for (int i = 0; i < pairs; ++i) across.middleRows<3>(3 * order[i]) = jumps.middleRows<3>(3 * i);
    const Eigen::LLT<Eigen::MatrixXd> held = k.llt();
    const Eigen::MatrixXd stiffness = Eigen::MatrixXd(across * held.solve(across.transpose()))
                                          .llt()
                                          .solve(Eigen::MatrixXd::Identity(3 * pairs, 3 * pairs));
    const Opening opening(stiffness, order, normals);
    const Opening::Load prepared = opening.prepare(stiffness * (across * held.solve(load)));
    const double scale = held.solve(load).norm();
    for (const int open : {0, 3, pairs}) {
      const Eigen::VectorXd expected =
          across * with_contact(k, jumps.bottomRows(3 * (pairs - open)), gaps.topRows(open), load);
      // The flexibility's condition is below 1e5.
      EXPECT_LT((opening.jumps(prepared, open, true) - expected).norm(), 1e-9 * scale)
          << "trial " << trial << ", " << open << " open";
    }
  }
}

}  // namespace cleft
